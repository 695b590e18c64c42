// apps/result_output.h: stdout carries results and nothing else.
#pragma once

#include "apps/fact_sheet.h"

namespace softscope {

/// Indented, with a newline; bytes that are no UTF-8 (old file names, DICOM texts) are replaced.
std::string jsonText(const FactSheet::Json& json);

void printJson(const FactSheet::Json& json);
void printFacts(const FactSheet& facts, bool as_json);

}  // namespace softscope
