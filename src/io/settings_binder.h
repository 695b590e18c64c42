// src/io/settings_binder.h: which settings there are, and the options that they fill.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/settings.h"

namespace softscope {

/// One setting as --help and a run's record show it.
struct SettingInfo {
  std::string key;
  std::string type;          // "true/false", "whole number", "number", "text"
  std::string default_text;  // the value when it was bound
  std::string current_text;
  std::string help;
};

/// Binds keys to the fields of option structs:
///   SettingsBinder binder;
///   binder.bind("stereo.support_step_px", options.support_step_px, "grid of support points");
///   binder.apply(settings);
/// Fields must outlive the binder. Ranges are the option structs' own validate().
class SettingsBinder {
 public:
  // Each throws Error where the key is bound already.
  void bind(const std::string& key, bool& field, const std::string& help);
  void bind(const std::string& key, int& field, const std::string& help);
  void bind(const std::string& key, double& field, const std::string& help);
  void bind(const std::string& key, std::string& field, const std::string& help);

  /// Sets the fields that `settings` names, all of them or none. Throws OptionError naming an
  /// unknown key, the nearest known one and where it came from, or a value of another type.
  void apply(const Settings& settings);

  /// In the order of binding.
  std::vector<SettingInfo> list() const;

 private:
  struct Entry {
    std::string key, type, default_text, help;
    std::function<std::string()> current;
    /// Checks the value and returns what would set the field.
    std::function<std::function<void()>(const std::string& key, const Setting&)> prepare;
  };
  template <class Field, class Convert>
  void add(const std::string& key, const char* type, Field& field, const std::string& help,
           Convert convert);
  const Entry& entryOf(const std::string& key, const Setting& setting) const;

  std::vector<Entry> entries_;
};

}  // namespace softscope
