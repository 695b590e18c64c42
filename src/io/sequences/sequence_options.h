// src/io/sequences/sequence_options.h: what of a sequence is read, and how.
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
  std::string layout = "auto";  // of one picture with both views: io/sequences/stereo_packing.h
  bool right_first = false;     // … whose right view comes first
  // Right picture f + offset belongs to left picture f: a whole number, or auto. The reader takes
  // auto for 0; who can match pictures may look for it first.
  std::string right_offset = "auto";
  int read_ahead = 4;  // frames kept ready
  CalibrationHints calibration;
  bool uncalibrated = false;  // where no calibration is named, the pair is taken to be rectified

  int rightOffset() const;

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

}  // namespace softscope
