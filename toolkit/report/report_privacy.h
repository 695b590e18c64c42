// toolkit/report/report_privacy.h: removal of personal data and paths from a report.
#pragma once

#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Text in which "the run", "the reference" and "the model" replace
/// the inputs of the record, and "[file]" any other path or file.
std::string withoutPaths(std::string text, const FactSheet::Json& record);

/// Applied to every text of the record; `inputs` is removed.
FactSheet::Json withoutPaths(const FactSheet::Json& record);

}  // namespace softscope
