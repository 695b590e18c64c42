// vtk_views/scenes/surface_actor.h: VTK actor of a surface.
#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>

#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/scenes/scene.h"

namespace softscope {

/// How a surface is drawn relative to the others.
struct SurfaceRole {
  double point_size_px = 1;
  bool see_through = false;
  bool unlit = false;    // its colours come from images and contain the illumination
  bool neutral = false;  // grey: another surface is coloured by errors
  Eigen::Vector3d shift_mm = Eigen::Vector3d::Zero();
};

/// With errors: coloured by them, unlit, as in the colour bar. Points: unlit,
/// in their own colours if present. Else lit, in the colour of the surface.
vtkSmartPointer<vtkActor> surfaceActor(const SceneSurface& surface, const ErrorColours& colours,
                                       const SurfaceRole& role);

/// Replaces the surface of an actor of surfaceActor(); faster than a new actor.
void redressSurface(const SceneSurface& surface, const ErrorColours& colours,
                    const SurfaceRole& role, vtkActor* actor);

}  // namespace softscope
