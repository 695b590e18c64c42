// vtk_views/scenes/point_splats.h: surface splats from points.
#pragma once

#include "vtk_views/scenes/scene.h"

namespace softscope {

/// Each point becomes a flat cone in its tangent plane with the apex at the point and a
/// radius from the distance of its neighbours: where splats overlap, that of the nearest
/// point is visible. Towards the rim, colours and errors blend into those of the
/// neighbours; a point without an error has a splat without error. `scale`: factor of
/// the radius; `eye_mm`: visible side. A surface with triangles is returned unchanged.
SceneSurface splatsOf(const SceneSurface& points, double scale, const Eigen::Vector3f& eye_mm);

}  // namespace softscope
