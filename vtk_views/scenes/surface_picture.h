// vtk_views/scenes/surface_picture.h: surfaces and points in three dimensions, off screen.
#pragma once

#include "core/image.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

struct SurfacePictureOptions {
  int width_px = 600, height_px = 600;
  double width_mm = 100;     // what the image's width shows
  double point_size_mm = 0;  // diameter of points; 0: so that they cover their surface
  bool see_through = false;  // the first surface, if others are there too
};

/// Parallel projection on white: sizes in the image are true everywhere, and later surfaces can
/// be drawn a little nearer to the eye, so that the first doesn't hide what lies just inside it. A
/// surface with errors has their colours, unlit, so that they are the bar's; one with a colour at
/// each vertex has these, the others are lit in their own, or in grey beside errors, which no tint
/// may falsify. The same scene gives the same pixels on one driver. Throws BackendError where
/// nothing renders.
ColourImage drawSurfaces(const std::vector<SceneSurface>& surfaces, const ErrorColours& colours,
                         const ViewPlane& camera, const SurfacePictureOptions& options);

}  // namespace softscope
