// src/io/settings/settings_text.h: the list of settings as a TOML file, a table and a document.
#pragma once

#include <string>
#include <vector>

#include "io/settings/settings_binder.h"

namespace softscope {

/// A commented settings file that reads back to the current values.
std::string settingsToml(const std::vector<SettingInfo>& settings);

/// One line per setting: key, value, range, unit, meaning.
std::string settingsTable(const std::vector<SettingInfo>& settings);

/// docs/settings.md: a table per group of keys; `paper` has the values of the paper's preset, in
/// the same order. Throws Error where the lists differ.
std::string settingsDocument(const std::vector<SettingInfo>& settings,
                             const std::vector<SettingInfo>& paper);

}  // namespace softscope
