// src/stereo/refinement/smooth_relief.h: returned relief that is alike over many windows.
#pragma once

#include <vector>

#include "core/raster.h"
#include "stereo/refinement/plane.h"

namespace softscope {

/// Mean of the relief over squares around each pixel, over the share of it that the steps return:
/// docs/stereo.md (4c).
class SmoothRelief {
 public:
  /// `response`: reliefResponse() of each pixel; `window`: weights along rows and columns, of an
  /// odd number of squares.
  SmoothRelief(const Plane& planes, const Plane& disparity, const Plane& response, int width,
               int height, const std::vector<float>& window);
  /// Of the pixels of row v.
  void row(int v, int width, float* relief_px) const;

 private:
  Raster<float> relief_px_;  // at the centres of the squares
};

}  // namespace softscope
