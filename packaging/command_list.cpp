#include "packaging/command_list.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "pipeline/options/run_options.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {
namespace {

// Names of values that are files; other names, except folders, are words.
constexpr std::array<std::string_view, 17> kFiles{
    "CASE",    "CASE...", "DATA",      "FILE",  "LEFT", "MESH",     "MODEL", "PATH",  "PATH...",
    "PICTURE", "POINTS",  "REFERENCE", "RIGHT", "SCAN", "SEQUENCE", "TEST",  "VOLUME"};

template <class Options>
std::vector<std::string> keysOf() {
  Options options;
  std::vector<std::string> keys;
  for (const SettingInfo& setting : settingsOf(options).list()) keys.push_back(setting.key);
  return keys;
}

std::vector<std::string> settingKeys(const std::string& command) {
  if (command == "simulate") return keysOf<SimulateOptions>();
  if (command == "depth") return keysOf<DepthOptions>();
  return keysOf<RunOptions>();
}

}  // namespace

std::vector<ListedCommand> listCommands() {
  std::vector<ListedCommand> listed;
  for (auto& command : allCommands()) {
    ListedCommand entry{std::move(command), {}, {}};
    entry.command->declare(entry.arguments);
    entry.command->common.declare(entry.arguments);
    entry.setting_keys = settingKeys(entry.command->name());
    listed.push_back(std::move(entry));
  }
  return listed;
}

ValueKind valueKind(const Argument& argument) {
  const std::string& name = argument.value_name;
  if (name.empty()) return ValueKind::kNone;
  if (name == "KEY=VALUE") return ValueKind::kSetting;
  if (name == "DIR" || name == "RUN" || name == "RUN...") return ValueKind::kFolder;
  const bool file = std::find(kFiles.begin(), kFiles.end(), name) != kFiles.end();
  return file ? ValueKind::kFile : ValueKind::kWord;
}

}  // namespace softscope
