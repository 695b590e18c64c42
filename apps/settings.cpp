// apps/settings.cpp: `softscope settings`: every setting of a command.
#include <iostream>

#include "apps/command.h"
#include "apps/exit_codes.h"
#include "apps/result_output.h"
#include "core/error.h"
#include "io/settings/settings_text.h"
#include "pipeline/options/run_options.h"
#include "toolkit/record/setting_json.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {
namespace {

using Json = FactSheet::Json;

std::vector<SettingInfo> listOf(const std::string& preset) {
  RunOptions options = RunOptions::ofPreset(preset);
  return settingsOf(options).list();
}

std::vector<SettingInfo> listOf(const std::string& command, const std::string& preset) {
  if (command == "simulate") {
    SimulateOptions options;
    return settingsOf(options).list();
  }
  if (command == "depth") {
    DepthOptions options;
    return settingsOf(options).list();
  }
  require(command == "reconstruct", "COMMAND", command, "must be reconstruct, depth or simulate");
  return listOf(preset);
}

Json jsonOf(const std::vector<SettingInfo>& settings) {
  Json json{{"schema_version", 1}, {"settings", Json::array()}};
  for (const SettingInfo& setting : settings)
    json["settings"].push_back({{"key", setting.key},
                                {"type", setting.type},
                                {"default", valueOf(setting)},
                                {"range", setting.range},
                                {"unit", setting.unit},
                                {"meaning", setting.help}});
  return json;
}

class SettingsCommand : public Command {
 public:
  std::string name() const override { return "settings"; }
  std::string summary() const override {
    return "all settings with range, default, unit and meaning; or a settings file";
  }
  std::string details() const override {
    return "These are the keys of --set and of the TOML files of --config (for simulate: "
           "--scenario).\n"
           "--toml writes a commented file with all defaults.";
  }
  std::string example() const override { return "softscope settings --toml > settings.toml"; }
  void declare(ArgumentList& arguments) override {
    arguments.positional("COMMAND", command_, "reconstruct (the default), depth or simulate",
                         false);
    arguments.option("--preset", "NAME", preset_, "of reconstruct: default, or paper");
    arguments.flag("--toml", toml_, "as a commented settings file");
    arguments.flag("--markdown", markdown_, "as docs/settings.md, with both presets");
  }

  int run() override {
    if (toml_ + markdown_ + common.json > 1)
      throw OptionError("--toml, --markdown and --json exclude each other; give one");
    if (command_ != "reconstruct" && (markdown_ || preset_ != "default"))
      throw OptionError("--markdown and --preset are for the settings of reconstruct only");
    const std::vector<SettingInfo> settings = listOf(command_, preset_);
    if (common.json)
      printJson(jsonOf(settings));
    else
      std::cout << (toml_       ? settingsToml(settings)
                    : markdown_ ? settingsDocument(listOf("default"), listOf("paper"))
                                : settingsTable(settings))
                << std::flush;
    return kDone;
  }

 private:
  std::string command_ = "reconstruct", preset_ = "default";
  bool toml_ = false, markdown_ = false;
};

}  // namespace

std::unique_ptr<Command> makeSettingsCommand() { return std::make_unique<SettingsCommand>(); }

}  // namespace softscope
