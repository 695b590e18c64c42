// src/io/sequences/stereo_packing.h: arrangement of both views in one image.
#pragma once

#include <string>

#include "core/image.h"

namespace softscope {

enum class StereoLayout {
  kSideBySide,  // left half, right half
  kTopBottom,   // upper half, lower half
  kInterlaced   // rows 0, 2, 4, … and rows 1, 3, 5, …
};

struct StereoPacking {
  StereoLayout layout = StereoLayout::kSideBySide;
  bool right_first = false;  // the right view is first
  bool full_height = false;  // interlaced only: interpolate the missing rows
};

/// Separates the views. A view has half the width or
/// height, unless full_height. Throws InputError
/// with `name` for an odd number of columns or rows.
StereoPair unpack(const ColourImage& packed, const StereoPacking& packing, const std::string& name);

/// Known properties of the views, for choosePacking().
struct ExpectedView {
  int width_px = 0;  // of the calibration; 0 = unknown
  int height_px = 0;
};

/// `layout`: "side-by-side", "top-bottom", "interlaced", or "auto": by the size in the calibration,
/// the aspect ratio of a view (0.8 to 2.2), then by the similarity of the parts with horizontal
/// displacement, which interlaced rows must show even if their size alone fits: those of one view
/// have none. Throws InputError if none fits or it is ambiguous, OptionError for another name.
StereoPacking choosePacking(const ColourImage& packed, const std::string& layout, bool right_first,
                            const ExpectedView& view, const std::string& name);

}  // namespace softscope
