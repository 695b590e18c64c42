// apps/stereo_settings.h: names for stereo's options, for settings files and --set.
#pragma once

#include "io/settings_binder.h"
#include "stereo/stereo_options.h"

namespace softscope {

/// Binds stereo.*, stereo.elas.* and stereo.refinement.*; every field of the structs has its key.
void bindStereoOptions(SettingsBinder& binder, StereoOptions& options);

}  // namespace softscope
