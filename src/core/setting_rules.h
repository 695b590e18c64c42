// src/core/setting_rules.h: rules for the values of settings, and their check.
//
// Beside every option struct stands one list of its settings:
//   template <class Visitor>
//   void describe(Visitor& v, SmoothingOptions& o) {
//     v("stereo.smoothing.reach_blocks", o.reach_blocks, between(0, 7), "of a window");
//   }
// A visitor takes key, field, rule (none for true/false) and meaning. RangeCheck checks the values;
// SettingsBinder (io) makes keys, records, help texts and documents of them.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace softscope {

/// Finite numbers between two bounds.
struct NumberRule {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_allowed = true, most_allowed = true;

  bool allows(double value) const;
  std::string text() const;  // "above 0, at most 1"
};

NumberRule anyNumber();
NumberRule above(double bound);
NumberRule atLeast(double bound);
NumberRule between(double least, double most);       // both allowed
NumberRule aboveUpTo(double bound, double most);     // above, at most
NumberRule fromToBelow(double least, double bound);  // at least, below

/// Allowed texts of a setting.
struct TextRule {
  std::vector<std::string> names;

  bool allows(const std::string& value) const;
  std::string text() const;  // "elas or sgbm"
};

TextRule oneOf(std::vector<std::string> names);

/// Text checked by validate() of the struct; `text` describes the rule.
struct FreeText {
  std::string text;
};

/// Values of an enumeration by name.
template <class Choice>
struct ChoiceRule {
  std::vector<std::pair<std::string, Choice>> names;

  TextRule texts() const {
    TextRule rule;
    for (const auto& [name, choice] : names) rule.names.push_back(name);
    return rule;
  }
  std::string text() const { return texts().text(); }
  std::string nameOf(Choice wanted) const {
    for (const auto& [name, choice] : names)
      if (choice == wanted) return name;
    return {};
  }
};

/// Visitor: throws OptionError with the key, its value and the violated rule.
class RangeCheck {
 public:
  void operator()(const char*, bool, const char*) const {}
  void operator()(const char* key, double value, const NumberRule& rule, const char*) const;
  void operator()(const char* key, const std::string& value, const TextRule& rule,
                  const char*) const;
  void operator()(const char*, const std::string&, const FreeText&, const char*) const {}
  template <class Choice>
  void operator()(const char*, Choice, const ChoiceRule<Choice>&, const char*) const {}
};

/// Checks every setting that describe() lists. Throws OptionError.
template <class Options>
void requireAllowed(const Options& options) {
  Options copy = options;  // describe() takes mutable fields
  RangeCheck check;
  describe(check, copy);
}

}  // namespace softscope
