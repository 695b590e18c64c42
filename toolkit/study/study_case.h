// toolkit/study/study_case.h: one case of a study, from its sequence to its errors.
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

/// SHA-256 of everything that decides a case's result: settings with their defaults, the bytes of
/// what it reads, softscope's version. Throws InputError where something can't be read.
std::string digestOf(const StudyCase& study_case);

/// What case.json says of a case, done, failed or skipped; null where there is none.
FactSheet::Json recordOf(const StudyCase& study_case, const StudyFolder& folder);

/// The same where it still holds. Of a case whose settings or inputs changed since: "status" is
/// "outdated", with a reason and no values; of one that can't be run here: skipped.
FactSheet::Json currentRecord(const StudyCase& study_case, const StudyFolder& folder);

/// The same of a case that is done with the digest that it has now; else null.
FactSheet::Json finishedRecord(const StudyCase& study_case, const StudyFolder& folder);

/// Runs a softscope command to its end, its output appended to `log`. Returns its exit code,
/// nothing where it was interrupted. The first word is the command ("reconstruct"), the others its
/// arguments.
using RunCommand = std::function<std::optional<int>(const std::vector<std::string>& words,
                                                    const std::filesystem::path& log)>;

/// Simulates where it must, reconstructs, evaluates, each by `run_command`; their output is
/// log.txt. Writes case.json ("status": done, failed or skipped) and returns it; null where
/// `interrupted` stopped it, then nothing is written.
FactSheet::Json runCase(const StudyCase& study_case, const StudyFolder& folder, int threads,
                        const std::function<bool()>& interrupted, const RunCommand& run_command);

}  // namespace softscope
