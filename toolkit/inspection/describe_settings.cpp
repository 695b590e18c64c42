// toolkit/inspection/describe_settings.cpp: facts about a settings file, per key.
#include "core/error.h"
#include "pipeline/options/run_options.h"
#include "toolkit/inspection/describe_file.h"

namespace softscope {
namespace {

/// Value set by the file; unknown keys and wrong types are problems.
void addSetting(const std::string& key, const Setting& setting, SettingsBinder& binder,
                FactSheet& facts) {
  try {
    binder.apply({{key, setting}});
  } catch (const OptionError& error) {
    facts.fail(error.what());
    return;
  }
  for (const SettingInfo& info : binder.list())
    if (info.key == key)
      facts.addLine(key, info.current_text +
                             (info.current_text == info.default_text
                                  ? " (the default)"
                                  : " (default " + info.default_text + ")") +
                             ": " + info.help);
}

}  // namespace

FactSheet describeSettings(const std::string& file) {
  const Settings settings = readSettings(file);
  FactSheet facts(file + ": settings");
  facts.addQuietly("kind", "settings");
  FactSheet::Json values = FactSheet::Json::object();
  RunOptions options;
  SettingsBinder binder = settingsOf(options);
  for (const auto& [key, setting] : settings) {
    addSetting(key, setting, binder, facts);
    values[key] = setting.text;
  }
  facts.addQuietly("settings", values);
  try {
    options.validate();
  } catch (const OptionError& error) {
    facts.fail(error.what());
  }
  return facts;
}

}  // namespace softscope
