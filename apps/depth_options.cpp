// apps/depth_options.cpp: the keys of `softscope depth`.
#include "apps/depth_options.h"

#include "apps/stereo_settings.h"

namespace softscope {

void DepthOptions::validate() const {
  measurement.validate();
  sequence.validate();
}

void bindFrameDepthOptions(SettingsBinder& binder, FrameDepthOptions& options) {
  binder.bind("depth.source", options.source,
              "auto: the sequence's depth/, else the views; stereo; files");
  binder.bind("depth.align_rows", options.align_rows,
              "remove what rows differ by after rectification, above 0.2 px");
  bindStereoOptions(binder, options.stereo);
}

void bindDepthOptions(SettingsBinder& binder, DepthOptions& options) {
  bindFrameDepthOptions(binder, options.measurement);
  bindSequenceOptions(binder, options.sequence);
}

Settings readSettingsArguments(const SettingsArguments& arguments) {
  Settings settings;
  if (!arguments.config_file.empty()) settings = readSettings(arguments.config_file);
  for (const std::string& assignment : arguments.assignments) addAssignment(settings, assignment);
  return settings;
}

}  // namespace softscope
