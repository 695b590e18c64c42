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
  std::string text;    // as written, without the quotes of a text
  std::string origin;  // "settings.toml:3", kAssigned or an option, for messages
};

/// Origin of settings of addAssignment().
inline constexpr const char* kAssigned = "`set=`";

/// Dotted key ("stereo.disparity_max_px") to value; later settings override earlier ones.
using Settings = std::map<std::string, Setting>;

/// TOML: [tables] and dotted keys, with true/false, integers, numbers or texts as values.
/// Throws InputError for a missing file or invalid TOML, OptionError for another type of value.
Settings readSettings(const std::filesystem::path& file);
Settings parseSettings(std::string_view toml, const std::string& name);

/// Adds "key=value" with a value in TOML syntax; other values are texts
/// (stereo.method=sgbm). `origin`: the option that states it, for messages.
/// Throws OptionError for a missing key or `=`.
void addAssignment(Settings& settings, std::string_view assignment,
                   const std::string& origin = kAssigned);

}  // namespace softscope
