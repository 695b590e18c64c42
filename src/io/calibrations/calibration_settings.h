// src/io/calibrations/calibration_settings.h: keys, ranges and meanings of calibration hints.
#pragma once

#include "core/setting_rules.h"
#include "io/calibrations/calibration_reader.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, CalibrationHints& o) {
  v("calibration.baseline_mm", o.baseline_mm, atLeast(0),
    "distance between the cameras where the file is silent or wrong; 0: the file's");
  v("calibration.unit", o.unit, oneOf({"", "mm", "cm", "m"}),
    "of T in the file; empty: as the file says");
  v("calibration.rectified", o.rectified, "the images are rectified, whatever the file says");
  v("calibration.image_size", o.image_size, FreeText{"empty or WIDTHxHEIGHT"},
    "in pixels, where the file is silent; empty: the images'");
}

}  // namespace softscope
