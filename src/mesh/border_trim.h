// src/mesh/border_trim.h: removal of thin triangles from a border.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Leaves out triangles that hang on by one side only and end in a tip sharper than
/// `sharpest_deg`, those that then do, and lone ones; the others keep their order. No side may be
/// in more than two triangles.
std::vector<Triangle> withoutSplinters(const std::vector<Eigen::Vector3f>& positions_mm,
                                       const std::vector<Triangle>& triangles, double sharpest_deg);

}  // namespace softscope
