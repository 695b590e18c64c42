// toolkit/report/report_privacy.h: what files say of people and machines stays out of a report.
#pragma once

#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// The text without the record's inputs ("the run", "the reference", "the model" stand instead) and
/// without anything else that looks like a path or a file ("[file]").
std::string withoutPaths(std::string text, const FactSheet::Json& record);

/// The record with every text treated so, and without `inputs`.
FactSheet::Json withoutPaths(const FactSheet::Json& record);

}  // namespace softscope
