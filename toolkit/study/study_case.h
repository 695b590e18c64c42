// toolkit/study/study_case.h: execution of one case of a study.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "toolkit/record/fact_sheet.h"
#include "toolkit/study/study_file.h"
#include "toolkit/study/study_folder.h"

namespace softscope {

/// SHA-256 of everything that determines the result of a case: settings with defaults,
/// bytes of the inputs, version of softscope. Throws InputError for an unreadable input.
std::string digestOf(const StudyCase& study_case);

/// Content of case.json (done, failed or skipped); null if missing.
FactSheet::Json recordOf(const StudyCase& study_case, const StudyFolder& folder);

/// Checked record: if settings or inputs of the case have changed, "status" is
/// "outdated" with a reason and without values; a case that cannot run here is skipped.
FactSheet::Json currentRecord(const StudyCase& study_case, const StudyFolder& folder);

/// Record of a complete case with the current digest; else null.
FactSheet::Json finishedRecord(const StudyCase& study_case, const StudyFolder& folder);

/// Runs a softscope command and appends its output to `log`. Returns
/// its exit code, none after an interruption. The first word is the
/// command ("reconstruct"), the others are its arguments.
using RunCommand = std::function<std::optional<int>(const std::vector<std::string>& words,
                                                    const std::filesystem::path& log)>;

/// Simulates if needed, reconstructs and evaluates, each by `run_command`; their
/// output is log.txt. Writes case.json ("status": done, failed or skipped) and
/// returns it; after an interruption returns null and writes nothing.
FactSheet::Json runCase(const StudyCase& study_case, const StudyFolder& folder, int threads,
                        const std::function<bool()>& interrupted, const RunCommand& run_command);

}  // namespace softscope
