// apps/depth_options.h: what `softscope depth` may be told beside its files.
#pragma once

#include "apps/common_options.h"
#include "io/sequence_options.h"
#include "io/settings_binder.h"
#include "pipeline/frame_depth.h"

namespace softscope {

/// Of one run of `softscope depth`.
struct DepthOptions {
  FrameDepthOptions measurement;
  SequenceOptions sequence;

  /// Throws OptionError.
  void validate() const;
};

/// Binds depth.* and stereo.*.
void bindFrameDepthOptions(SettingsBinder& binder, FrameDepthOptions& options);

/// Binds depth.*, stereo.*, sequence.*, calibration.*.
void bindDepthOptions(SettingsBinder& binder, DepthOptions& options);

/// --config, then --set. Throws OptionError or InputError.
Settings readSettingsArguments(const SettingsArguments& arguments);

}  // namespace softscope
