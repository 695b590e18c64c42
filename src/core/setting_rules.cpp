#include "core/setting_rules.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "core/error.h"

namespace softscope {
namespace {

std::string textOf(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

[[noreturn]] void fail(const char* key, const std::string& value, const std::string& rule) {
  throw OptionError(std::string(key) + " is " + value + ", expected " + rule);
}

}  // namespace

bool NumberRule::allows(double value) const {
  if (!std::isfinite(value)) return false;
  return (least_allowed ? value >= least : value > least) &&
         (most_allowed ? value <= most : value < most);
}

std::string NumberRule::text() const {
  const bool ends = std::isfinite(most);
  if (!std::isfinite(least)) return ends ? "at most " + textOf(most) : "a number";
  if (ends && least_allowed && most_allowed) return textOf(least) + " to " + textOf(most);
  const std::string from = least_allowed ? textOf(least) + " or more" : "above " + textOf(least);
  if (!ends) return from;
  return from + (most_allowed ? ", at most " : ", below ") + textOf(most);
}

NumberRule anyNumber() { return {}; }

NumberRule above(double bound) {
  NumberRule rule;
  rule.least = bound;
  rule.least_allowed = false;
  return rule;
}

NumberRule atLeast(double bound) {
  NumberRule rule;
  rule.least = bound;
  return rule;
}

NumberRule between(double least, double most) { return {least, most, true, true}; }
NumberRule aboveUpTo(double bound, double most) { return {bound, most, false, true}; }
NumberRule fromToBelow(double least, double bound) { return {least, bound, true, false}; }

bool TextRule::allows(const std::string& value) const {
  return std::find(names.begin(), names.end(), value) != names.end();
}

std::string TextRule::text() const {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i == 0                  ? ""
            : i + 1 == names.size() ? " or "
                                    : ", ") +
           (names[i].empty() ? "empty" : names[i]);
  return all;
}

TextRule oneOf(std::vector<std::string> names) { return {std::move(names)}; }

void RangeCheck::operator()(const char* key, double value, const NumberRule& rule,
                            const char*) const {
  if (!rule.allows(value)) fail(key, textOf(value), rule.text());
}

void RangeCheck::operator()(const char* key, const std::string& value, const TextRule& rule,
                            const char*) const {
  if (!rule.allows(value)) fail(key, value, rule.text());
}

}  // namespace softscope
