// src/io/settings/settings.h: keys and values of settings files and `--set`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>

namespace softscope {

struct Setting {
  std::variant<bool, std::int64_t, double, std::string> value;
  std::string text;    // as it was written, without the quotes of a text
  std::string origin;  // "settings.toml:3" or kAssigned, for messages
};

/// The origin of a setting that addAssignment() added.
inline constexpr const char* kAssigned = "`set=`";

/// Dotted key ("stereo.disparity_max_px") to value; later ones win.
using Settings = std::map<std::string, Setting>;

/// TOML: [tables] and dotted keys, whose values are true/false, whole numbers, numbers or texts.
/// Throws InputError where the file is missing or no TOML, OptionError on another kind of value.
Settings readSettings(const std::filesystem::path& file);
Settings parseSettings(std::string_view toml, const std::string& name);

/// Adds "key=value", value as in TOML; what TOML wouldn't take is a text (stereo.method=sgbm).
/// Throws OptionError where there is no key or no `=`.
void addAssignment(Settings& settings, std::string_view assignment);

}  // namespace softscope
