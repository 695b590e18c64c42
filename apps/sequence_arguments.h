// apps/sequence_arguments.h: arguments of a sequence.
#pragma once

#include <string>

#include "apps/argument_list.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"

namespace softscope {

/// A sequence folder, or two images, folders or videos with their calibration, or one
/// video with both views. `left` and `right` are positional arguments of the command.
struct SequenceArguments {
  std::string left, right, calibration, mask, frames;

  /// --calibration, --mask, --frames.
  void declareOptions(ArgumentList& arguments);

  /// Throws OptionError for a missing calibration, InputError if `left`
  /// is not a sequence. `calibrated` false: the calibration is optional.
  SequencePaths paths(const std::string& command, bool calibrated = true) const;
  /// Sets the range of --frames, if given. Throws OptionError.
  void applyFrames(SequenceOptions& options) const;
};

}  // namespace softscope
