#include "io/document.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/message.h"
#include "io/text_lines.h"

namespace softscope {
namespace {

Document documentOf(const nlohmann::json& json, const std::string& name, int depth) {
  if (depth > kDeepestNesting) throw InputError(name + ": nested too deeply to be a calibration.");
  Document out;
  if (json.is_object()) {
    out.kind = Document::Kind::kMap;
    for (const auto& [key, value] : json.items())
      out.members.emplace_back(key, documentOf(value, name, depth + 1));
  } else if (json.is_array()) {
    out.kind = Document::Kind::kList;
    for (const auto& value : json) out.items.push_back(documentOf(value, name, depth + 1));
  } else if (json.is_string()) {
    out.text = json.get<std::string>();
  } else if (json.is_number_float()) {
    out.text = exactText(json.get<double>());
  } else if (!json.is_null()) {
    out.text = json.dump();
  }
  return out;
}

}  // namespace

const Document* Document::find(std::string_view key) const {
  for (const auto& [name, value] : members)
    if (name == key) return &value;
  return nullptr;
}

Document parseJson(std::string_view text, const std::string& name) {
  try {
    return documentOf(nlohmann::json::parse(text), name, 0);
  } catch (const nlohmann::json::out_of_range&) {
    throw InputError(name + ": holds a number beyond all bounds. Export it again.");
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(say(name, ": not valid JSON from byte ", error.byte, " on. Export it again."));
  }
}

Document parseDocument(std::string_view text, const std::string& name) {
  const std::string_view content = trimmed(text);
  if (!content.empty() && content.front() == '<') return parseXml(text, name);
  if (!content.empty() && content.front() == '{') return parseJson(text, name);
  return parseYaml(text, name);
}

}  // namespace softscope
