// eval/distance/morton_order.h: points in the order of a space-filling curve, neighbours together.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace softscope {

/// Farther out, squares of distances are no longer finite in float.
constexpr float kFarthestPoint_mm = 1e15f;

/// Indices of the points that are finite and within kFarthestPoint_mm, sorted by the Morton code of
/// their place in the box (points outside count as on its side), equal codes by index.
std::vector<std::uint32_t> mortonOrder(const std::vector<Eigen::Vector3f>& points_mm,
                                       const Eigen::Vector3f& low_mm,
                                       const Eigen::Vector3f& high_mm);

}  // namespace softscope
