// src/io/documents/toml_tree.cpp: conversion of toml++ nodes.
#include "io/documents/toml_tree.h"

#include <toml++/toml.h>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"

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
                          ": a date is not supported, but a number, a text, a list or a table is "
                          "expected. Put a date between quotes."));
  Json json = Json::object();
  for (const auto& [key, value] : *table) json[std::string(key.str())] = jsonOf(value, name);
  return json;
}

constexpr int kDeepestToml = 64;  // dots of one key, or nested brackets

/// Counts dots since the last end of a key, and open brackets, outside of texts and comments.
class TomlDepth {
 public:
  /// False if the limit is exceeded.
  bool step(char c) {
    if (comment_) {
      comment_ = c != '\n';
    } else if (quote_ != 0) {
      if (!escaped_ && (c == quote_ || c == '\n')) quote_ = 0;
      escaped_ = !escaped_ && quote_ == '"' && c == '\\';
    } else {
      plain(c);
    }
    line_ += c == '\n';
    return dots_ <= kDeepestToml && brackets_ <= kDeepestToml;
  }
  int line() const { return line_; }

 private:
  void plain(char c) {
    if (c == '#') comment_ = true;
    if (c == '"' || c == '\'') quote_ = c;
    if (c == '[' || c == '{') ++brackets_;
    if (c == ']' || c == '}') --brackets_;
    if (c == '.') ++dots_;
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots_ = 0;
  }

  char quote_ = 0;
  bool comment_ = false, escaped_ = false;
  int dots_ = 0, brackets_ = 0, line_ = 1;
};

}  // namespace

void requireShallowToml(std::string_view toml, const std::string& name) {
  TomlDepth depth;
  for (const char c : toml)
    if (!depth.step(c))
      throw InputError(say(name, ":", depth.line(), ": a key of more than ", kDeepestToml,
                           " parts, or as many brackets within brackets. Is it a settings file?"));
}

std::string tomlComplaint(std::string_view description) {
  constexpr std::size_t kMost = 160;
  if (const std::size_t end = description.find(": "); end != std::string_view::npos)
    description.remove_prefix(end + 2);
  return excerpt(description, kMost);
}

nlohmann::ordered_json parseTomlTree(std::string_view toml, const std::string& name) {
  requireShallowToml(toml, name);
  try {
    return jsonOf(toml::parse(toml), name);
  } catch (const toml::parse_error& error) {
    throw InputError(say(name, ":", error.source().begin.line, ": not valid TOML: ",
                         tomlComplaint(error.description()), ". Mend the line."));
  }
}

nlohmann::ordered_json readTomlTree(const std::filesystem::path& file) {
  return parseTomlTree(readText(file, kCalibrationLimitBytes), shown(file));
}

}  // namespace softscope
