// apps/result_output.h: results on stdout, as JSON or text.
#pragma once

#include <string>
#include <vector>

#include "toolkit/record/fact_sheet.h"

namespace softscope {

void printJson(const FactSheet::Json& json);
void printFacts(const FactSheet& facts, bool as_json);

/// Output of a command that measures: its record, with its warnings on stderr as well, or its
/// facts and the `written` files (empty names are omitted).
void printResult(const FactSheet::Json& record, FactSheet facts,
                 const std::vector<std::string>& written, bool as_json);

/// One line on stderr: files of a figure and its record.
void reportWritten(const std::vector<std::string>& files, const std::string& record);

}  // namespace softscope
