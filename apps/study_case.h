// apps/study_case.h: one case of a study, from its sequence to its errors.
#pragma once

#include <functional>

#include "apps/fact_sheet.h"
#include "apps/study_file.h"
#include "apps/study_folder.h"

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

/// Simulates where it must, reconstructs, evaluates, each as a process of its own; what they said
/// is in log.txt. Writes case.json ("status": done, failed or skipped) and returns it; null where
/// `interrupted` stopped it, then nothing is written.
FactSheet::Json runCase(const StudyCase& study_case, const StudyFolder& folder, int threads,
                        const std::function<bool()>& interrupted);

}  // namespace softscope
