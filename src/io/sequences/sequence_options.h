// src/io/sequences/sequence_options.h: options of reading a sequence.
#pragma once

#include <string>

#include "core/frame_range.h"
#include "io/calibrations/calibration_reader.h"

namespace softscope {

/// "A:B" is A up to, not with, B; "A:B:STEP" every STEP-th of them. Each may be left out ("10:",
/// ":20", "::5"). Throws OptionError.
FrameRange parseFrameRange(const std::string& text);

struct SequenceOptions {
  FrameRange frames;
  std::string layout = "auto";  // of one image with both views: io/sequences/stereo_packing.h
  bool right_first = false;     // … whose right view comes first
  // Right image f + offset belongs to left image f: a whole number, or auto. The reader takes
  // auto for 0; a caller that matches images may look for it first.
  std::string right_offset = "auto";
  int read_ahead = 4;  // frames kept ready
  CalibrationHints calibration;
  bool uncalibrated = false;  // where no calibration is named, the pair is taken to be rectified

  int rightOffset() const;

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

}  // namespace softscope
