// src/io/settings/settings_text.h: list of settings as a TOML file, table and document.
#pragma once

#include <string>
#include <vector>

#include "io/settings/settings_binder.h"

namespace softscope {

/// Commented settings file with the current values.
std::string settingsToml(const std::vector<SettingInfo>& settings);

/// One line per setting: key, value, range, unit, meaning.
std::string settingsTable(const std::vector<SettingInfo>& settings);

/// docs/settings.md: one table per group of keys; `paper` has the values of the
/// preset of the paper, in the same order. Throws Error for different lists.
std::string settingsDocument(const std::vector<SettingInfo>& settings,
                             const std::vector<SettingInfo>& paper);

}  // namespace softscope
