#include "io/settings/settings_binder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/nearest_name.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

std::string textOf(bool value) { return value ? "true" : "false"; }
std::string textOf(int value) { return std::to_string(value); }
std::string textOf(std::uint32_t value) { return std::to_string(value); }
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

/// On the command line a text has no quotes, even if it looks like a number.
std::string textValueOf(const std::string& key, const Setting& setting) {
  if (!std::holds_alternative<std::string>(setting.value) && setting.origin != kAssigned)
    failType(key, setting, "a text in quotes");
  if (!isOneLine(setting.text)) failType(key, setting, "a text of one line");
  return setting.text;
}

[[noreturn]] void failRange(const std::string& key, const Setting& setting,
                            const std::string& expected) {
  throw OptionError(
      say(setting.origin, ": ", key, " is ", printable(setting.text), ", expected ", expected));
}

double allowed(double value, const NumberRule& rule, const std::string& key,
               const Setting& setting) {
  if (!rule.allows(value)) failRange(key, setting, rule.text());
  return value;
}

std::string allowed(std::string value, const TextRule& rule, const std::string& key,
                    const Setting& setting) {
  if (!rule.allows(value)) failRange(key, setting, rule.text());
  return value;
}

/// The unit is the last word of the key.
std::string unitOf(const std::string& key) {
  static const std::map<std::string, std::string> kUnits{
      {"mm", "mm"}, {"px", "px"}, {"deg", "deg"}, {"s", "s"}, {"blocks", "blocks"}};
  const auto found = kUnits.find(key.substr(key.find_last_of("_.") + 1));
  return found == kUnits.end() ? "" : found->second;
}

/// Value of `field`, and its setter; `convert` checks.
template <class Field, class Convert>
auto accessTo(Field& field, Convert convert) {
  const auto prepare = [&field, convert](const std::string& key, const Setting& setting) {
    return std::function<void()>([&field, value = convert(key, setting)] { field = value; });
  };
  return std::pair(std::function<std::string()>([&field] { return textOf(field); }), prepare);
}

}  // namespace

void SettingsBinder::add(Entry entry) {
  for (const Entry& other : entries_)
    if (other.info.key == entry.info.key)
      throw Error("the setting " + entry.info.key + " is bound twice.");
  entry.info.unit = unitOf(entry.info.key);
  entry.info.default_text = entry.current();
  entries_.push_back(std::move(entry));
}

void SettingsBinder::operator()(const std::string& key, bool& field, const std::string& help) {
  const auto [current, prepare] = accessTo(field, flagOf);
  add({{key, "true/false", "", "true or false", "", "", help}, current, prepare});
}

void SettingsBinder::operator()(const std::string& key, int& field, const NumberRule& rule,
                                const std::string& help) {
  const auto [current, prepare] =
      accessTo(field, [rule](const std::string& name, const Setting& setting) {
        return static_cast<int>(allowed(wholeOf(name, setting), rule, name, setting));
      });
  add({{key, "whole number", "", rule.text(), "", "", help}, current, prepare});
}

void SettingsBinder::operator()(const std::string& key, std::uint32_t& field,
                                const NumberRule& rule, const std::string& help) {
  const auto [current, prepare] =
      accessTo(field, [rule](const std::string& name, const Setting& setting) {
        return static_cast<std::uint32_t>(allowed(wholeOf(name, setting), rule, name, setting));
      });
  add({{key, "whole number", "", rule.text(), "", "", help}, current, prepare});
}

void SettingsBinder::operator()(const std::string& key, double& field, const NumberRule& rule,
                                const std::string& help) {
  const auto [current, prepare] =
      accessTo(field, [rule](const std::string& name, const Setting& setting) {
        return allowed(numberValueOf(name, setting), rule, name, setting);
      });
  add({{key, "number", "", rule.text(), "", "", help}, current, prepare});
}

void SettingsBinder::operator()(const std::string& key, std::string& field, const TextRule& rule,
                                const std::string& help) {
  const auto [current, prepare] =
      accessTo(field, [rule](const std::string& name, const Setting& setting) {
        return allowed(textValueOf(name, setting), rule, name, setting);
      });
  add({{key, "text", "", rule.text(), "", "", help}, current, prepare});
}

void SettingsBinder::operator()(const std::string& key, std::string& field, const FreeText& rule,
                                const std::string& help) {
  const auto [current, prepare] = accessTo(field, textValueOf);
  add({{key, "text", "", rule.text, "", "", help}, current, prepare});
}

void SettingsBinder::addChoice(const std::string& key, const TextRule& names,
                               const std::string& help, std::function<std::string()> current,
                               std::function<void(std::size_t)> choose) {
  const auto prepare = [names, choose](const std::string& name, const Setting& setting) {
    const std::string text = allowed(textValueOf(name, setting), names, name, setting);
    const auto at = std::find(names.names.begin(), names.names.end(), text);
    const auto index = static_cast<std::size_t>(at - names.names.begin());
    return std::function<void()>([choose, index] { choose(index); });
  };
  add({{key, "text", "", names.text(), "", "", help}, std::move(current), prepare});
}

const SettingsBinder::Entry& SettingsBinder::entryOf(const std::string& key,
                                                     const Setting& setting) const {
  std::vector<std::string> known;
  for (const Entry& entry : entries_) {
    if (entry.info.key == key) return entry;
    known.push_back(entry.info.key);
  }
  const std::string nearest = nearestName(key, known);
  throw OptionError(say(setting.origin, ": there is no setting ", excerpt(key), ". ",
                        nearest.empty() ? "`softscope settings COMMAND` lists them all."
                                        : "Did you mean " + nearest + "?"));
}

void SettingsBinder::apply(const Settings& settings) {
  std::vector<std::function<void()>> assignments;
  for (const auto& [key, setting] : settings)
    assignments.push_back(entryOf(key, setting).prepare(key, setting));
  for (const auto& assign : assignments) assign();
}

std::vector<SettingInfo> SettingsBinder::list() const {
  std::vector<SettingInfo> out;
  for (const Entry& entry : entries_) {
    out.push_back(entry.info);
    out.back().current_text = entry.current();
  }
  return out;
}

}  // namespace softscope
