// src/io/sequences/stereo_packing.h: both views in one image.
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
  bool right_first = false;  // the right view comes first
  bool full_height = false;  // interlaced alone: fill the missing rows from their neighbours
};

/// Parts the views. A view has half the width or height, unless full_height.
/// Throws InputError, in the name of `name`, where the image has an odd number of columns or
/// rows to part.
StereoPair unpack(const ColourImage& packed, const StereoPacking& packing, const std::string& name);

/// What an image's views are like, for choosePacking().
struct ExpectedView {
  int width_px = 0;  // the calibration's; 0 = unknown
  int height_px = 0;
};

/// `layout`: "side-by-side", "top-bottom", "interlaced", or "auto": by the calibration's size, by
/// the shape of a view (aspect 0.8 to 2.2), then by which two parts show the same scene, shifted
/// sideways. Throws InputError where nothing fits or it can't be told, OptionError on another name.
StereoPacking choosePacking(const ColourImage& packed, const std::string& layout, bool right_first,
                            const ExpectedView& view, const std::string& name);

}  // namespace softscope
