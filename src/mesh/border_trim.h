// src/mesh/border_trim.h: removal of thin triangles from a border.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Removes triangles with a single neighbour and a tip angle below
/// `sharpest_deg`, iteratively, and isolated triangles; the others
/// keep their order. No side may belong to more than two triangles.
std::vector<Triangle> withoutSplinters(const std::vector<Eigen::Vector3f>& positions_mm,
                                       const std::vector<Triangle>& triangles, double sharpest_deg);

}  // namespace softscope
