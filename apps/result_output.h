// apps/result_output.h: stdout carries results and nothing else.
#pragma once

#include <string>
#include <vector>

#include "apps/fact_sheet.h"

namespace softscope {

/// Indented, with a newline; bytes that are no UTF-8 (old file names, DICOM texts) are replaced.
std::string jsonText(const FactSheet::Json& json);

void printJson(const FactSheet::Json& json);
void printFacts(const FactSheet& facts, bool as_json);

/// The end of a command that measures: its record, or its facts and where results were `written`
/// (empty names aren't told).
void printResult(const FactSheet::Json& record, FactSheet facts,
                 const std::vector<std::string>& written, bool as_json);

}  // namespace softscope
