// toolkit/record/record_values.h: values in a JSON record by their path.
#pragma once

#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Number at a path "a.b.c"; NaN if absent or of another type, as in records of other versions.
double numberAt(const FactSheet::Json& record, const std::string& path);
/// Text at a path; empty if absent or of another type.
std::string textAt(const FactSheet::Json& record, const std::string& path);

}  // namespace softscope
