// vtk_views/scenes/point_splats.h: points of a surface as small round pieces of it.
#pragma once

#include "vtk_views/scenes/scene.h"

namespace softscope {

/// Each point becomes a flat cone in its tangent plane, as wide as its neighbours are far, whose
/// apex is the point: of overlapping pieces the nearest point's is seen. Towards the rim colours
/// and errors go over into those of the neighbours, so that the image has no steps; where a point
/// has no error, nothing of it has. `scale` is of the width; `eye_mm`: the side that is seen.
/// Points alone count; a surface with triangles is returned as it is.
SceneSurface splatsOf(const SceneSurface& points, double scale, const Eigen::Vector3f& eye_mm);

}  // namespace softscope
