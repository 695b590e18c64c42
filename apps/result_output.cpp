// apps/result_output.cpp: JSON or text.
#include "apps/result_output.h"

#include <spdlog/spdlog.h>

#include <iostream>

#include "toolkit/record/json_text.h"

namespace softscope {

void printJson(const FactSheet::Json& json) { std::cout << jsonText(json) << std::flush; }

void printFacts(const FactSheet& facts, bool as_json) {
  std::cout << (as_json ? jsonText(facts.json()) : facts.text()) << std::flush;
}

void printResult(const FactSheet::Json& record, FactSheet facts,
                 const std::vector<std::string>& written, bool as_json) {
  if (as_json) {
    for (const FactSheet::Json& warning : record.value("warnings", FactSheet::Json::array()))
      spdlog::warn("{}", warning.get<std::string>());
    return printJson(record);
  }
  std::string label = "written to";
  for (const std::string& name : written) {
    if (name.empty()) continue;
    facts.addLine(label, name);
    label.clear();
  }
  printFacts(facts, false);
}

void reportWritten(const std::vector<std::string>& files, const std::string& record) {
  std::string all;
  for (const std::string& file : files) all += file + ", ";
  spdlog::info("written: {}{}", all, record);
}

}  // namespace softscope
