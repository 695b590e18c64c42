// vtk_views/scenes/point_spacing.h: point spacing of a model, for the size of its dots.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace softscope {

/// How far neighbouring points of a surface lie apart, about; 1 for fewer than two points.
double surfaceSpacingMm(const std::vector<Eigen::Vector3f>& points_mm);

/// So that the dots of neighbours overlap, also where the surface turns or is thinner.
double dotSizeMm(const std::vector<Eigen::Vector3f>& points_mm);

}  // namespace softscope
