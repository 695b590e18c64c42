// toolkit/study/study_settings.h: arguments of the commands from the keys of a case.
#pragma once

#include <string>
#include <vector>

#include "toolkit/study/study_file.h"

namespace softscope {

/// Arguments without `softscope`, folders last.
std::vector<std::string> simulateWords(const StudyCase& study_case, const std::string& folder);
std::vector<std::string> reconstructWords(const StudyCase& study_case, const std::string& sequence,
                                          const std::string& run);
std::vector<std::string> evaluateWords(const StudyCase& study_case, const std::string& run,
                                       const std::string& reference, const std::string& out);

/// Every setting that determines the result, one per line, including defaults.
/// Throws OptionError for an unknown key or invalid value, so it also checks a case.
std::string simulationText(const StudyCase& study_case);
std::string reconstructionText(const StudyCase& study_case);
std::string evaluationText(const StudyCase& study_case);

}  // namespace softscope
