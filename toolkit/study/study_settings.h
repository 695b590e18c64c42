// toolkit/study/study_settings.h: a case's keys as the commands take them.
#pragma once

#include <string>
#include <vector>

#include "toolkit/study/study_file.h"

namespace softscope {

/// Command lines without `softscope`, folders at their end.
std::vector<std::string> simulateWords(const StudyCase& study_case, const std::string& folder);
std::vector<std::string> reconstructWords(const StudyCase& study_case, const std::string& sequence,
                                          const std::string& run);
std::vector<std::string> evaluateWords(const StudyCase& study_case, const std::string& run,
                                       const std::string& reference, const std::string& out);

/// Every setting that decides the result, one a line, defaults included. Throws OptionError where a
/// key is unknown or its value can't be: so they check a case as well.
std::string simulationText(const StudyCase& study_case);
std::string reconstructionText(const StudyCase& study_case);
std::string evaluationText(const StudyCase& study_case);

}  // namespace softscope
