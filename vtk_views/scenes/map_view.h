// vtk_views/scenes/map_view.h: default view of an error map.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "vtk_views/files/error_map.h"

namespace softscope {

/// Columns: right, up, towards the viewer, for a view along the map's `look`.
Eigen::Matrix3f viewAxes(const ErrorMap& map);

/// The box, along those axes of `view`, that holds nearly all points of all maps: without the
/// outermost two percent at each side, so that a few outliers don't shrink the rest, and a
/// little wider.
Eigen::AlignedBox3f mostOfPoints(const ErrorMap& view, const std::vector<const ErrorMap*>& maps);

/// About how far neighbouring points lie apart, mm, seen along the map's `look`.
double pointSpacingMm(const ErrorMap& map);

}  // namespace softscope
