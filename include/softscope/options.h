// include/softscope/options.h: settings by name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "softscope/error.h"

namespace softscope::api {

/// One setting as docs/settings.md lists it.
struct SettingDescription {
  std::string key, type, unit, range, default_text, meaning;
};

/// Every setting of Reconstructor, of DepthEstimator, of simulate().
std::vector<SettingDescription> reconstructionSettings();
std::vector<SettingDescription> depthSettings();
std::vector<SettingDescription> simulationSettings();

/// What differs from the defaults: key to value, as `--set key=value` takes them.
class Options {
 public:
  /// Throws OptionError: an unknown key, a value of another type or out of its range.
  Options& set(const std::string& key, const std::string& value);

  const std::map<std::string, std::string>& values() const { return values_; }

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace softscope::api
