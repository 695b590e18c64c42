// src/io/sequence_settings.h: keys, ranges and meanings of the settings of a sequence's reading.
#pragma once

#include "core/setting_rules.h"
#include "io/sequence_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, CalibrationHints& o) {
  v("calibration.baseline_mm", o.baseline_mm, atLeast(0),
    "distance between the cameras where the file is silent or wrong; 0: the file's");
  v("calibration.unit", o.unit, oneOf({"", "mm", "cm", "m"}),
    "of T in the file; empty: as the file says");
  v("calibration.rectified", o.rectified, "the images are rectified, whatever the file says");
  v("calibration.image_width_px", o.image_width_px, atLeast(0),
    "where the file is silent; 0: the images'");
  v("calibration.image_height_px", o.image_height_px, atLeast(0),
    "where the file is silent; 0: the images'");
}

template <class Visitor>
void describe(Visitor& v, SequenceOptions& o) {
  v("sequence.layout", o.layout, oneOf({"auto", "side-by-side", "top-bottom", "interlaced"}),
    "both views in one image");
  v("sequence.right_first", o.right_first, "in such an image the right view comes first");
  v("sequence.right_offset", o.right_offset, FreeText{"auto or a whole number of -1000 to 1000"},
    "right image f + offset belongs to left image f");
  describe(v, o.calibration);
}

}  // namespace softscope
