#include "io/settings/settings.h"

#include <toml++/toml.h>

#include "core/decimal_number.h"
#include "core/error.h"
#include "io/documents/toml_tree.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

Setting settingOf(const toml::node& node, const std::string& key, const std::string& origin) {
  Setting out;
  out.origin = origin;
  if (const auto* flag = node.as_boolean()) {
    out.value = flag->get();
    out.text = flag->get() ? "true" : "false";
  } else if (const auto* whole = node.as_integer()) {
    out.value = whole->get();
    out.text = std::to_string(whole->get());
  } else if (const auto* number = node.as_floating_point()) {
    out.value = number->get();
    out.text = exactText(number->get());
  } else if (const auto* text = node.as_string()) {
    out.value = text->get();
    out.text = text->get();
  } else {
    throw OptionError(
        say(origin, ": ", excerpt(key),
            " is a list or a date, but a setting is true/false, a number or a text."));
  }
  return out;
}

void flatten(const toml::table& table, const std::string& head, const std::string& name,
             Settings& out) {
  for (const auto& [key, node] : table) {
    const std::string path = head.empty() ? std::string(key.str()) : say(head, ".", key.str());
    if (const toml::table* inner = node.as_table()) {
      flatten(*inner, path, name, out);
    } else {
      out[path] = settingOf(node, path, say(name, ":", node.source().begin.line));
    }
  }
}

/// Value parsed by TOML; else a number that TOML does not know (.5), or a text.
Setting valueOf(const std::string& key, const std::string& value, const std::string& origin) {
  requireShallowToml(value, origin + " " + printable(key));
  try {
    const toml::table table = toml::parse("x = " + value);
    if (table.size() == 1) {
      Setting out = settingOf(*table.get("x"), key, origin);
      if (!std::holds_alternative<std::string>(out.value)) out.text = value;
      return out;
    }
  } catch (const toml::parse_error&) {
  }
  if (const auto number = decimalNumber<double>(value)) return {*number, value, origin};
  return {value, value, origin};
}

}  // namespace

Settings parseSettings(std::string_view toml, const std::string& name) {
  Settings out;
  requireShallowToml(toml, name);
  try {
    flatten(toml::parse(toml), "", name, out);
  } catch (const toml::parse_error& error) {
    throw InputError(say(name, ":", error.source().begin.line, ": not valid TOML: ",
                         tomlComplaint(error.description()), ". Mend the line."));
  }
  return out;
}

Settings readSettings(const std::filesystem::path& file) {
  return parseSettings(readText(file, kCalibrationLimitBytes), shown(file));
}

void addAssignment(Settings& settings, std::string_view assignment, const std::string& origin) {
  const std::size_t equals = assignment.find('=');
  const std::string key(trimmed(assignment.substr(0, equals)));
  if (equals == std::string_view::npos || key.empty())
    throw OptionError(say(origin, " ", excerpt(assignment),
                          ": key=value is expected, such as stereo.method=sgbm."));
  settings[key] = valueOf(key, std::string(trimmed(assignment.substr(equals + 1))), origin);
}

}  // namespace softscope
