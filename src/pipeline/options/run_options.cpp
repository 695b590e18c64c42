#include "pipeline/options/run_options.h"

#include "core/error.h"
#include "io/sequences/sequence_settings.h"
#include "pipeline/options/reconstruction_settings.h"

namespace softscope {

RunOptions RunOptions::ofPreset(const std::string& preset) {
  RunOptions options;
  if (preset == "paper")
    options.method = ReconstructionOptions::paper();
  else
    require(preset == "default", "`preset=`", "`" + preset + "`", "must be default or paper");
  return options;
}

void RunOptions::validate() const {
  method.validate();
  sequence.validate();
}

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> kNames{"default", "paper"};
  return kNames;
}

void DepthOptions::validate() const {
  measurement.validate();
  sequence.validate();
}

SettingsBinder settingsOf(RunOptions& options) {
  SettingsBinder binder;
  describe(binder, options.sequence);
  describe(binder, options.method);
  return binder;
}

SettingsBinder settingsOf(DepthOptions& options) {
  SettingsBinder binder;
  describe(binder, options.sequence);
  describe(binder, options.measurement);
  return binder;
}

}  // namespace softscope
