// src/io/toml_tree.cpp: one walk over toml++'s nodes.
#include "io/toml_tree.h"

#include <toml++/toml.h>

#include "core/error.h"
#include "io/file_bytes.h"
#include "io/message.h"

namespace softscope {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const toml::node& node, const std::string& name) {
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* list = node.as_array()) {
    Json json = Json::array();
    for (const toml::node& element : *list) json.push_back(jsonOf(element, name));
    return json;
  }
  const auto* table = node.as_table();
  if (table == nullptr)
    throw OptionError(say(name, ":", node.source().begin.line,
                          ": a date stands here, but a number, a text, a list or a table is "
                          "expected. Put a date between quotes."));
  Json json = Json::object();
  for (const auto& [key, value] : *table) json[std::string(key.str())] = jsonOf(value, name);
  return json;
}

}  // namespace

nlohmann::ordered_json parseTomlTree(std::string_view toml, const std::string& name) {
  try {
    return jsonOf(toml::parse(toml), name);
  } catch (const toml::parse_error& error) {
    throw InputError(say(name, ":", error.source().begin.line,
                         ": not valid TOML: ", excerpt(error.description()), ". Mend the line."));
  }
}

nlohmann::ordered_json readTomlTree(const std::filesystem::path& file) {
  return parseTomlTree(readBytes(file, kCalibrationLimitBytes), shown(file));
}

}  // namespace softscope
