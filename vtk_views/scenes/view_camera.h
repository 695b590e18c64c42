// vtk_views/scenes/view_camera.h: VTK camera from our camera or a scope's pose.
#pragma once

#include <vtkRenderer.h>

#include <Eigen/Geometry>

#include "core/camera.h"
#include "vtk_views/scenes/view_plane.h"

namespace softscope {

/// Parallel projection, as figures have it: sizes are true everywhere. `height_mm` of the image,
/// the eye `depth_mm` before the plane's centre.
void aimParallel(vtkRenderer* renderer, const ViewPlane& view, double height_mm, double depth_mm);

/// What the scope itself sees from `world_from_left`, turning about a point `focus_mm` ahead. Where
/// the image's shape is another, its height shows the scope's whole height, or its width the
/// whole width, whichever shows more. `aspect`: of the renderer, width / height.
void aimAsScope(vtkRenderer* renderer, const PinholeCamera& left,
                const Eigen::Isometry3d& world_from_left, double focus_mm, double aspect);

/// From perspective to parallel projection, with what lies at the focal point as large as before.
void makeParallel(vtkRenderer* renderer);

}  // namespace softscope
