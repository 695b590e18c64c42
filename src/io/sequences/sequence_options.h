// src/io/sequences/sequence_options.h: options of the sequence reader.
#pragma once

#include <string>

#include "core/frame_range.h"
#include "io/calibrations/calibration_reader.h"

namespace softscope {

/// "A:B": A up to B, exclusive; "A:B:STEP": every STEP-th frame.
/// Each part is optional ("10:", ":20", "::5"). Throws OptionError.
FrameRange parseFrameRange(const std::string& text);

struct SequenceOptions {
  FrameRange frames;
  std::string layout = "auto";  // packing of both views: io/sequences/stereo_packing.h
  bool right_first = false;     // … with the right view first
  // Right image f + offset belongs to left image f: an integer, or auto. The reader
  // treats auto as 0; callers with a matcher can estimate the offset before.
  std::string right_offset = "auto";
  int read_ahead = 4;  // frames in the queue
  CalibrationHints calibration;
  bool uncalibrated = false;  // without a calibration file the pair is assumed to be rectified

  int rightOffset() const;

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

}  // namespace softscope
