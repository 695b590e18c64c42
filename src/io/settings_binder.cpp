#include "io/settings_binder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/message.h"
#include "io/nearest_name.h"
#include "io/text_lines.h"

namespace softscope {
namespace {

std::string textOf(bool value) { return value ? "true" : "false"; }
std::string textOf(int value) { return std::to_string(value); }
std::string textOf(double value) { return exactText(value); }
std::string textOf(const std::string& value) { return value; }

[[noreturn]] void failType(const std::string& key, const Setting& setting, const char* expected) {
  throw OptionError(say(setting.origin, ": ", key, " is ", excerpt(setting.text), ", but ",
                        expected, " is expected."));
}

bool flagOf(const std::string& key, const Setting& setting) {
  if (const bool* flag = std::get_if<bool>(&setting.value)) return *flag;
  failType(key, setting, "true or false");
}

int wholeOf(const std::string& key, const Setting& setting) {
  const auto* whole = std::get_if<std::int64_t>(&setting.value);
  if (!whole || *whole < std::numeric_limits<int>::min() ||
      *whole > std::numeric_limits<int>::max())
    failType(key, setting, "a whole number");
  return static_cast<int>(*whole);
}

double numberValueOf(const std::string& key, const Setting& setting) {
  if (const auto* whole = std::get_if<std::int64_t>(&setting.value))
    return static_cast<double>(*whole);
  const double* number = std::get_if<double>(&setting.value);
  if (!number || !std::isfinite(*number)) failType(key, setting, "a number");
  return *number;
}

bool isOneLine(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 32; });
}

/// On the command line a text needs no quotes, even if it looks like a number.
std::string textValueOf(const std::string& key, const Setting& setting) {
  if (!std::holds_alternative<std::string>(setting.value) && setting.origin != "--set")
    failType(key, setting, "a text in quotes");
  if (!isOneLine(setting.text)) failType(key, setting, "a text of one line");
  return setting.text;
}

}  // namespace

template <class Field, class Convert>
void SettingsBinder::add(const std::string& key, const char* type, Field& field,
                         const std::string& help, Convert convert) {
  for (const Entry& entry : entries_)
    if (entry.key == key) throw Error("the setting " + key + " is bound twice.");
  const auto prepare = [&field, convert](const std::string& name, const Setting& setting) {
    return std::function<void()>([&field, value = convert(name, setting)] { field = value; });
  };
  entries_.push_back({key, type, textOf(field), help, [&field] { return textOf(field); }, prepare});
}

void SettingsBinder::bind(const std::string& key, bool& field, const std::string& help) {
  add(key, "true/false", field, help, flagOf);
}
void SettingsBinder::bind(const std::string& key, int& field, const std::string& help) {
  add(key, "whole number", field, help, wholeOf);
}
void SettingsBinder::bind(const std::string& key, double& field, const std::string& help) {
  add(key, "number", field, help, numberValueOf);
}
void SettingsBinder::bind(const std::string& key, std::string& field, const std::string& help) {
  add(key, "text", field, help, textValueOf);
}

const SettingsBinder::Entry& SettingsBinder::entryOf(const std::string& key,
                                                     const Setting& setting) const {
  std::vector<std::string> known;
  for (const Entry& entry : entries_) {
    if (entry.key == key) return entry;
    known.push_back(entry.key);
  }
  const std::string nearest = nearestName(key, known);
  throw OptionError(
      say(setting.origin, ": there is no setting ", excerpt(key), ". ",
          nearest.empty() ? "--help lists them all." : "Did you mean " + nearest + "?"));
}

void SettingsBinder::apply(const Settings& settings) {
  std::vector<std::function<void()>> assignments;
  for (const auto& [key, setting] : settings)
    assignments.push_back(entryOf(key, setting).prepare(key, setting));
  for (const auto& assign : assignments) assign();
}

std::vector<SettingInfo> SettingsBinder::list() const {
  std::vector<SettingInfo> out;
  for (const Entry& entry : entries_)
    out.push_back({entry.key, entry.type, entry.default_text, entry.current(), entry.help});
  return out;
}

}  // namespace softscope
