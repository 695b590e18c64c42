// vtk_views/scenes/slice_picture.h: image of a plane through a volume.
#pragma once

#include "core/image.h"
#include "core/raster.h"
#include "vtk_views/scenes/view_plane.h"
#include "vtk_views/volumes/grey_window.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// Field of view around the centre of a plane, mm.
struct SliceField {
  double width_mm = 100;
  double height_mm = 100;
};

/// Values of the volume on the plane; NaN outside. Row 0 is at the top;
/// pixels are square if image and field have the same aspect ratio.
Raster<float> sliceValues(const Volume& volume, const ViewPlane& plane, const SliceField& field,
                          int width_px, int height_px);

/// The same in grey; black outside.
ColourImage slicePicture(const Volume& volume, const ViewPlane& plane, const SliceField& field,
                         const GreyWindow& window, int width_px, int height_px);

}  // namespace softscope
