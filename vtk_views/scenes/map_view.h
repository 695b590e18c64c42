// vtk_views/scenes/map_view.h: default view of an error map.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "vtk_views/files/error_map.h"

namespace softscope {

/// Columns: right, up, towards the viewer, for the `look` direction of the map.
Eigen::Matrix3f viewAxes(const ErrorMap& map);

/// Box along those axes of `view` that contains
/// nearly all points of all maps: without two
/// percent of outliers at each side, plus a margin.
Eigen::AlignedBox3f mostOfPoints(const ErrorMap& view, const std::vector<const ErrorMap*>& maps);

/// Approximate distance of neighbouring points, mm, in the `look` direction of the map.
double pointSpacingMm(const ErrorMap& map);

}  // namespace softscope
