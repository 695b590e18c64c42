// apps/depth_options.h: what `softscope depth` may be told beside its files.
#pragma once

#include "apps/common_options.h"
#include "io/sequence_options.h"
#include "io/settings_binder.h"
#include "stereo/stereo_options.h"

namespace softscope {

/// Of one run of `softscope depth`.
struct DepthOptions {
  StereoOptions stereo;
  SequenceOptions sequence;
  std::string source = "stereo";  // or "files": the sequence's own depth/
  bool align_rows = true;         // remove a residual row error where it is large enough

  /// Throws OptionError.
  void validate() const;
};

/// Binds depth.*, stereo.*, sequence.*, calibration.*.
void bindDepthOptions(SettingsBinder& binder, DepthOptions& options);

/// --config, then --set. Throws OptionError or InputError.
Settings readSettingsArguments(const SettingsArguments& arguments);

}  // namespace softscope
