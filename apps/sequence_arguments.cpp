// apps/sequence_arguments.cpp: a folder contains its own calibration.
#include "apps/sequence_arguments.h"

#include <filesystem>

#include "core/error.h"

namespace softscope {

void SequenceArguments::declareOptions(ArgumentList& arguments) {
  arguments.option("--calibration", "FILE", calibration,
                   "calibration; a sequence folder contains its own");
  arguments.option("--mask", "PATH", mask,
                   "folder, or one image for all frames; non-zero pixels are ignored");
  arguments.option("--frames", "A:B:STEP", frames,
                   "frames A to B (exclusive), every STEP-th; each part is optional");
}

SequencePaths SequenceArguments::paths(const std::string& command, bool calibrated) const {
  std::error_code ignored;  // reported by the reader
  const bool is_file = std::filesystem::is_regular_file(left, ignored);
  const bool is_folder = std::filesystem::is_directory(left, ignored);
  SequencePaths paths;
  if (right.empty() && (is_folder || (calibration.empty() && !is_file))) {
    paths = findSequence(left);
  } else if (calibration.empty() && (calibrated || right.empty())) {
    throw OptionError("softscope " + command +
                      ": --calibration is missing; only a sequence folder contains its own");
  } else if (right.empty()) {
    paths.stereo = left;
  } else {
    paths.left = left;
    paths.right = right;
  }
  if (!calibration.empty()) paths.calibration = calibration;
  if (!mask.empty()) paths.setMask(mask);
  return paths;
}

void SequenceArguments::applyFrames(SequenceOptions& options) const {
  if (!frames.empty()) options.frames = parseFrameRange(frames);
}

}  // namespace softscope
