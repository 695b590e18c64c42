// vtk_views/scenes/point_spacing.h: point spacing of a model, for the size of its dots.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace softscope {

/// Approximate distance of neighbouring points of a surface; 1 for fewer than two points.
double surfaceSpacingMm(const std::vector<Eigen::Vector3f>& points_mm);

/// Size at which dots of neighbours overlap, with a margin for inclined or sparse parts.
double dotSizeMm(const std::vector<Eigen::Vector3f>& points_mm);

}  // namespace softscope
