// vtk_views/scenes/surface_actor.h: a surface of a scene as VTK draws it.
#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>

#include "vtk_views/drawing/error_colours.h"
#include "vtk_views/scenes/scene.h"

namespace softscope {

/// How a surface is drawn beside the others.
struct SurfaceRole {
  double point_size_px = 1;
  bool see_through = false;
  bool unlit = false;    // its colours are a photograph's, which have their light in them
  bool neutral = false;  // grey: another surface has the colours of errors
  Eigen::Vector3d shift_mm = Eigen::Vector3d::Zero();
};

/// With errors: in their colours, unlit, so that they are the bar's. Points: unlit, in their own
/// colours where they have some. Else lit, in the surface's colour.
vtkSmartPointer<vtkActor> surfaceActor(const SceneSurface& surface, const ErrorColours& colours,
                                       const SurfaceRole& role);

/// Gives an actor that surfaceActor() made another surface to show; faster than a new one.
void redressSurface(const SceneSurface& surface, const ErrorColours& colours,
                    const SurfaceRole& role, vtkActor* actor);

}  // namespace softscope
