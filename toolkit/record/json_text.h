// toolkit/record/json_text.h: JSON text for files and the terminal.
#pragma once

#include <string>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Indented, with a final newline; invalid UTF-8 (old file names, DICOM texts) is replaced.
std::string jsonText(const FactSheet::Json& json);

}  // namespace softscope
