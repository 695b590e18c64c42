#include "io/settings/settings_text.h"

#include <algorithm>

#include "core/error.h"

namespace softscope {
namespace {

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

/// "0 to 1", "above 0 mm".
std::string rangeOf(const SettingInfo& setting) {
  return setting.unit.empty() ? setting.range : setting.range + " " + setting.unit;
}

std::string tomlValue(const SettingInfo& setting) {
  if (setting.type != "text") return setting.current_text;
  std::string quoted = "\"";
  for (const char c : setting.current_text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string groupOf(const SettingInfo& setting) {
  return setting.key.substr(0, setting.key.find('.'));
}

std::string shownValue(const std::string& text) { return text.empty() ? "empty" : text; }

const char* const kDocumentHead =
    "# Settings\n"
    "Every setting of `softscope reconstruct`: give it as `--set key=value`, or in a TOML file "
    "with "
    "`--config`. `softscope depth` takes those of `sequence`, `calibration`, `depth` and `stereo`. "
    "`softscope settings` prints this list, `softscope settings --toml` writes a commented file of "
    "the defaults, and `run.json` records all values of a run. A value out of its range ends the "
    "program with exit code 2 and names the key.\n"
    "\n"
    "This page is written by `softscope settings --markdown`. The column paper has the value of "
    "`--preset paper` where it differs from the default.\n";

}  // namespace

std::string settingsToml(const std::vector<SettingInfo>& settings) {
  std::string text = "# Settings of softscope, each with its meaning and range.\n";
  for (const SettingInfo& setting : settings)
    text += "\n# " + setting.help + ": " + rangeOf(setting) + "\n" + setting.key + " = " +
            tomlValue(setting) + "\n";
  return text;
}

std::string settingsTable(const std::vector<SettingInfo>& settings) {
  std::size_t key = 0, value = 0, range = 0;
  for (const SettingInfo& setting : settings) {
    key = std::max(key, setting.key.size());
    value = std::max(value, shownValue(setting.current_text).size());
    range = std::max(range, rangeOf(setting).size());
  }
  std::string text;
  for (const SettingInfo& setting : settings)
    text += padded(setting.key, key + 2) + padded(shownValue(setting.current_text), value + 2) +
            padded(rangeOf(setting), range + 2) + setting.help + "\n";
  return text;
}

std::string settingsDocument(const std::vector<SettingInfo>& settings,
                             const std::vector<SettingInfo>& paper) {
  if (settings.size() != paper.size()) throw Error("the presets have different settings.");
  std::string text = kDocumentHead, group;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const SettingInfo& setting = settings[i];
    if (paper[i].key != setting.key) throw Error("the presets have different settings.");
    if (groupOf(setting) != group) {
      group = groupOf(setting);
      text += "\n## " + group +
              "\n| Key | Default | Paper | Range | Unit | Meaning |\n|---|---|---|---|---|---|\n";
    }
    const bool differs = paper[i].current_text != setting.current_text;
    text += "| `" + setting.key + "` | " + shownValue(setting.current_text) + " | " +
            (differs ? paper[i].current_text : "") + " | " + setting.range + " | " + setting.unit +
            " | " + setting.help + " |\n";
  }
  return text;
}

}  // namespace softscope
