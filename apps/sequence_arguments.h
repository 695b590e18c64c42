// apps/sequence_arguments.h: arguments that name a sequence.
#pragma once

#include <string>

#include "apps/argument_list.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"

namespace softscope {

/// A sequence folder, or two images, folders or videos with their calibration, or one video that
/// holds both views. `left` and `right` are the command's own positional arguments.
struct SequenceArguments {
  std::string left, right, calibration, mask, frames;

  /// --calibration, --mask, --frames.
  void declareOptions(ArgumentList& arguments);

  /// Throws OptionError where the calibration is missing, InputError where `left` is no sequence.
  /// `calibrated` false: the calibration may be missing.
  SequencePaths paths(const std::string& command, bool calibrated = true) const;
  /// Into `options`, where --frames was given. Throws OptionError.
  void applyFrames(SequenceOptions& options) const;
};

}  // namespace softscope
