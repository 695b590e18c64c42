// vtk_views/scenes/view_camera.h: VTK camera from a view plane or from the scope.
#pragma once

#include <vtkRenderer.h>

#include <Eigen/Geometry>

#include "core/camera.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// Parallel projection, as in figures: a common scale. `height_mm` of
/// the image; eye at `depth_mm` in front of the centre of the plane.
void aimParallel(vtkRenderer* renderer, const ViewPlane& view, double height_mm, double depth_mm);

/// View of the scope from `world_from_left`, with the focal point `focus_mm` ahead.
/// For another aspect ratio the view contains the full height or the full width of
/// the scope's image, the larger of both. `aspect`: of the renderer, width / height.
void aimAsScope(vtkRenderer* renderer, const PinholeCamera& left,
                const Eigen::Isometry3d& world_from_left, double focus_mm, double aspect);

/// From perspective to parallel projection, with the same scale at the focal point.
void makeParallel(vtkRenderer* renderer);

}  // namespace softscope
