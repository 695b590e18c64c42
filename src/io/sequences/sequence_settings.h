// src/io/sequences/sequence_settings.h: keys, ranges
// and meanings of the settings of the sequence reader.
#pragma once

#include "core/setting_rules.h"
#include "io/calibrations/calibration_settings.h"
#include "io/sequences/sequence_options.h"

namespace softscope {

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
