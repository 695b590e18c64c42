// toolkit/face/options.cpp: implementation of include/softscope/options.h.
#include "softscope/options.h"

#include "io/settings/settings.h"
#include "toolkit/face/run_options_of.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope::api {

namespace {

template <class Made>
Made filled(const Options& options) {
  Made made;
  Settings settings;
  for (const auto& [key, value] : options.values()) addAssignment(settings, key + "=" + value);
  settingsOf(made).apply(settings);
  made.validate();
  return made;
}

template <class Described>
std::vector<SettingDescription> listed() {
  Described options;
  std::vector<SettingDescription> all;
  for (const SettingInfo& s : settingsOf(options).list())
    all.push_back({s.key, s.type, s.unit, s.range, s.default_text, s.help});
  return all;
}

}  // namespace

RunOptions runOptionsOf(const Options& options) { return filled<RunOptions>(options); }

DepthOptions depthOptionsOf(const Options& options) { return filled<DepthOptions>(options); }

Options& Options::set(const std::string& key, const std::string& value) {
  RunOptions checked;
  Settings settings;
  addAssignment(settings, key + "=" + value);
  settingsOf(checked).apply(settings);
  values_[key] = value;
  return *this;
}

std::vector<SettingDescription> reconstructionSettings() { return listed<RunOptions>(); }
std::vector<SettingDescription> depthSettings() { return listed<DepthOptions>(); }
std::vector<SettingDescription> simulationSettings() { return listed<SimulateOptions>(); }

}  // namespace softscope::api
