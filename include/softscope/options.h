// include/softscope/options.h: settings by name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// Setting as listed in docs/settings.md.
struct SettingDescription {
  std::string key, type, unit, range, default_text, meaning;
};

/// Settings of Reconstructor, DepthEstimator and simulate().
std::vector<SettingDescription> reconstructionSettings();
std::vector<SettingDescription> depthSettings();
std::vector<SettingDescription> simulationSettings();

/// Values that differ from the defaults: key to value, as in `--set key=value`.
class Options {
 public:
  /// Throws OptionError: an unknown key, a value of another type or out of range.
  Options& set(const std::string& key, const std::string& value);

  const std::map<std::string, std::string>& values() const { return values_; }

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace softscope::api
