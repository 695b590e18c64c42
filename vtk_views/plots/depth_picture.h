// vtk_views/plots/depth_picture.h: figure of a
// stereo frame: left image, depth, colour bar.
#pragma once

#include <string>

#include "core/image.h"
#include "core/raster.h"
#include "vtk_views/drawing/canvas.h"

namespace softscope {

/// Range of the colour bar; nearest_mm < farthest_mm.
struct DepthRange {
  double nearest_mm = 0;
  double farthest_mm = 1;
};

/// Central 98 % of the measured depths, extended to round
/// numbers; at least 1 mm. 0 to 100 mm without any depth.
DepthRange depthRangeToShow(const Raster<float>& depth_mm);

struct DepthPictureText {
  std::string title;  // above both panels
  std::string note;   // below them, e.g. coverage
};

/// Layout for images of a given size.
struct DepthPictureLayout {
  int width_px = 0;
  int height_px = 0;
  int font_px = 0;
  Box photograph;
  Box depth;
  Box bar;  // top = farthest
};

DepthPictureLayout layoutDepthPicture(int picture_width_px, int picture_height_px);

/// Left image and depth in viridis, dark = near; unmeasured and masked
/// pixels in greys with a legend; arrows on the bar for depths outside of
/// it. All rasters have the same shape, or the mask is empty; else Error.
ColourImage drawDepthPicture(const ColourImage& left, const Raster<float>& depth_mm,
                             const Mask& mask, const DepthRange& range,
                             const DepthPictureText& text);

}  // namespace softscope
