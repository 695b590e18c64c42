// vtk_views/scenes/surface_picture.h: off-screen image of surfaces and points.
#pragma once

#include "core/image.h"
#include "vtk_views/scenes/scene.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

struct SurfacePictureOptions {
  int width_px = 600, height_px = 600;
  double width_mm = 100;     // field of view
  double point_size_mm = 0;  // diameter; 0: from the spacing, so that points cover the surface
  bool see_through = false;  // first surface transparent, if there are others
};

/// Parallel projection on white: a common scale, and later surfaces can be
/// drawn slightly nearer to the eye, so that the first does not hide them. A
/// surface with errors is coloured by them, unlit, as in the colour bar; one
/// with vertex colours has these, the others are lit in their own colour, or
/// in grey next to errors, to keep the error colours unambiguous.
/// Deterministic for a given driver. Throws BackendError without a renderer.
ColourImage drawSurfaces(const std::vector<SceneSurface>& surfaces, const ErrorColours& colours,
                         const ViewPlane& camera, const SurfacePictureOptions& options);

}  // namespace softscope
