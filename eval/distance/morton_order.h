// eval/distance/morton_order.h: order of points along a space-filling curve.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace softscope {

/// Beyond this limit, squared distances overflow in float.
constexpr float kFarthestPoint_mm = 1e15f;

/// Indices of the finite points within kFarthestPoint_mm, sorted by the Morton code of
/// their position in the box (points outside are clamped to it), equal codes by index.
std::vector<std::uint32_t> mortonOrder(const std::vector<Eigen::Vector3f>& points_mm,
                                       const Eigen::Vector3f& low_mm,
                                       const Eigen::Vector3f& high_mm);

}  // namespace softscope
