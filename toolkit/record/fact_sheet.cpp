// toolkit/record/fact_sheet.cpp: text and JSON from one list.
#include "toolkit/record/fact_sheet.h"

#include <algorithm>
#include <cstdio>

#include "io/text/message.h"

namespace softscope {
namespace {

constexpr int kSchemaVersion = 1;

nlohmann::ordered_json::json_pointer pointerTo(const std::string& key) {
  std::string path = "/" + key;
  std::replace(path.begin(), path.end(), '.', '/');
  return nlohmann::ordered_json::json_pointer(path);
}

}  // namespace

void FactSheet::add(const std::string& label, const std::string& text, const std::string& key,
                    Json value) {
  lines_.emplace_back(label, text);
  addQuietly(key, std::move(value));
}

void FactSheet::addQuietly(const std::string& key, Json value) {
  json_[pointerTo(key)] = std::move(value);
}

std::string FactSheet::text() const {
  std::size_t widest = 0;
  for (const auto& line : lines_) widest = std::max(widest, printable(line.first).size());
  std::string text = printable(title_) + "\n";
  for (const auto& [label, value] : lines_) {
    const std::string head = printable(label);
    text += "  " + head + std::string(widest + 2 - head.size(), ' ') + printable(value) + "\n";
  }
  for (const std::string& problem : problems_) text += "  error: " + printable(problem) + "\n";
  for (const std::string& warning : warnings_) text += "  warning: " + printable(warning) + "\n";
  for (const std::string& lack : missing_) text += "  missing: " + printable(lack) + "\n";
  return text;
}

FactSheet::Json FactSheet::json() const {
  Json all = Json::object();
  all["schema_version"] = kSchemaVersion;
  all.update(json_);
  all["problems"] = problems_;
  all["warnings"] = warnings_;
  all["missing"] = missing_;
  return all;
}

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

}  // namespace softscope
