// toolkit/record/json_text.h: JSON as bytes of a file or of the terminal.
#pragma once

#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Indented, with a newline; bytes that are no UTF-8 (old file names, DICOM texts) are replaced.
std::string jsonText(const FactSheet::Json& json);

}  // namespace softscope
