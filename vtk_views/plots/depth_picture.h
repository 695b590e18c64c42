// vtk_views/plots/depth_picture.h: one stereo frame as a figure: the photograph, its depth, the
// scale.
#pragma once

#include <string>

#include "core/image.h"
#include "core/raster.h"
#include "vtk_views/drawing/canvas.h"

namespace softscope {

/// What the colour bar spans; nearest_mm < farthest_mm.
struct DepthRange {
  double nearest_mm = 0;
  double farthest_mm = 1;
};

/// Spans the middle 98 % of the measured depths and a little more, to round numbers; at least 1 mm.
/// A frame without any depth gives 0 to 100 mm.
DepthRange depthRangeToShow(const Raster<float>& depth_mm);

struct DepthPictureText {
  std::string title;  // above both panels
  std::string note;   // below them, e.g. coverage
};

/// Where things are drawn, for images of a given size.
struct DepthPictureLayout {
  int width_px = 0;
  int height_px = 0;
  int font_px = 0;
  Box photograph;
  Box depth;
  Box bar;  // top = farthest
};

DepthPictureLayout layoutDepthPicture(int picture_width_px, int picture_height_px);

/// Photograph beside depth in viridis, dark = near; not measured and masked pixels in greys that
/// the legend names; arrows on the bar where depths lie beyond it. All three rasters have one
/// shape, or the mask is empty; else Error.
ColourImage drawDepthPicture(const ColourImage& left, const Raster<float>& depth_mm,
                             const Mask& mask, const DepthRange& range,
                             const DepthPictureText& text);

}  // namespace softscope
