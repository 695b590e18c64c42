// vtk_views/scenes/slice_picture.h: image of a plane through a volume.
#pragma once

#include "core/image.h"
#include "core/raster.h"
#include "vtk_views/scenes/view_plane.h"
#include "vtk_views/volumes/grey_window.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// The part of a plane that an image shows, around the plane's centre, mm.
struct SliceField {
  double width_mm = 100;
  double height_mm = 100;
};

/// The volume's values on the plane; NaN beyond it. Row 0 is at the top; pixels are square if the
/// shape of image and field agree.
Raster<float> sliceValues(const Volume& volume, const ViewPlane& plane, const SliceField& field,
                          int width_px, int height_px);

/// The same in grey; black beyond the volume.
ColourImage slicePicture(const Volume& volume, const ViewPlane& plane, const SliceField& field,
                         const GreyWindow& window, int width_px, int height_px);

}  // namespace softscope
