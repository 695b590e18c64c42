// src/io/settings/settings_binder.h: settings bound to the fields of option structs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/setting_rules.h"
#include "io/settings/settings.h"

namespace softscope {

/// Setting in help texts, documents and the record of a run.
struct SettingInfo {
  std::string key;
  std::string type;          // "true/false", "whole number", "number", "text"
  std::string unit;          // "mm", from the suffix of the key; empty: none
  std::string range;         // "above 0", "elas or sgbm"
  std::string default_text;  // value when bound
  std::string current_text;
  std::string help;
};

/// Visitor of describe() (core/setting_rules.h): binds keys
/// to the fields of option structs. SettingsBinder binder;
/// describe(binder, options); binder.apply(settings);
/// Fields must outlive the binder. Rules between settings
/// are checked by validate() of the options.
class SettingsBinder {
 public:
  // Each throws Error for a key that is already bound.
  void operator()(const std::string& key, bool& field, const std::string& help);
  void operator()(const std::string& key, int& field, const NumberRule& rule,
                  const std::string& help);
  void operator()(const std::string& key, std::uint32_t& field, const NumberRule& rule,
                  const std::string& help);
  void operator()(const std::string& key, double& field, const NumberRule& rule,
                  const std::string& help);
  void operator()(const std::string& key, std::string& field, const TextRule& rule,
                  const std::string& help);
  void operator()(const std::string& key, std::string& field, const FreeText& rule,
                  const std::string& help);
  template <class Choice>
  void operator()(const std::string& key, Choice& field, const ChoiceRule<Choice>& rule,
                  const std::string& help) {
    addChoice(
        key, rule.texts(), help, [&field, rule] { return rule.nameOf(field); },
        [&field, rule](std::size_t index) { field = rule.names[index].second; });
  }

  /// Sets the fields of `settings`, all of them or none. Throws
  /// OptionError for an unknown key, with the nearest known key and
  /// its origin, or for a value of another type or out of range.
  void apply(const Settings& settings);

  /// In the order of binding.
  std::vector<SettingInfo> list() const;

 private:
  struct Entry {
    SettingInfo info;
    std::function<std::string()> current;
    /// Checks the value and returns its setter.
    std::function<std::function<void()>(const std::string& key, const Setting&)> prepare;
  };
  void add(Entry entry);
  void addChoice(const std::string& key, const TextRule& names, const std::string& help,
                 std::function<std::string()> current, std::function<void(std::size_t)> choose);
  const Entry& entryOf(const std::string& key, const Setting& setting) const;

  std::vector<Entry> entries_;
};

}  // namespace softscope
