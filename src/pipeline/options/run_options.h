// src/pipeline/options/run_options.h: options of commands that read a sequence.
#pragma once

#include <string>
#include <vector>

#include "io/sequences/sequence_options.h"
#include "io/settings/settings_binder.h"
#include "pipeline/options/reconstruction_options.h"

namespace softscope {

/// Options of one run of `softscope reconstruct`.
struct RunOptions {
  ReconstructionOptions method;
  SequenceOptions sequence;

  /// Options of `preset`. Throws OptionError for a name that presetNames() does not have.
  static RunOptions ofPreset(const std::string& preset);

  /// Throws OptionError: the key, its value, the violated rule.
  void validate() const;
};

const std::vector<std::string>& presetNames();

/// Of one run of `softscope depth`.
struct DepthOptions {
  FrameDepthOptions measurement;
  SequenceOptions sequence;

  /// Throws OptionError.
  void validate() const;
};

/// Every setting of `options`, which must outlive the binder.
SettingsBinder settingsOf(RunOptions& options);
SettingsBinder settingsOf(DepthOptions& options);

}  // namespace softscope
