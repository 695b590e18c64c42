// src/fusion/density_formulas.h: cell of a model point, and the merging of two points, for the CPU
// and the GPU.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/hd.h"
#include "fusion/cell_table.h"
#include "fusion/model_point.h"
#include "fusion/point_spacing.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// Whether a point remains in the model: with weight and normal.
SOFTSCOPE_HD inline bool isKeptInModel(const Eigen::Vector3f& normal, float weight) {
  const float length = normal.squaredNorm();
  return weight > 0 && length > 0.25f && length < 4;
}

/// Cell of a point: docs/fusion.md (F17). Cells
/// of different widths have different keys.
SOFTSCOPE_HD inline CellKey densityCell(const Eigen::Vector3f& point_world,
                                        const PosedCamera& camera, float cell_mm) {
  constexpr int kWidthBit = 60;  // cells less than 2^18 from the origin leave it free
  const int halvings = halvingsAt(camera.toLeft(point_world).z(), camera.fx_px, cell_mm);
  const CellKey key =
      cellKey(point_world, Eigen::Vector3f::Constant(std::ldexp(cell_mm, -halvings)));
  return key == kNoCell ? kNoCell : key ^ static_cast<CellKey>(halvings) << kWidthBit;
}

/// Whether two points of a cell are on the same side of the surface: (F17).
SOFTSCOPE_HD inline bool onSameSide(const Eigen::Vector3f& a_normal,
                                    const Eigen::Vector3f& b_normal, float least_cosine) {
  return a_normal.dot(b_normal) > least_cosine;
}

/// Merges a lighter point into the remaining one: (F18).
SOFTSCOPE_HD inline void mergeInto(const ModelPoint& other, ModelPoint* survivor) {
  const float share = other.weight / (survivor->weight + other.weight);
  const float height_mm = survivor->normal.dot(other.position_mm - survivor->position_mm);
  survivor->position_mm += survivor->normal * (share * height_mm);
  survivor->normal = ((1 - share) * survivor->normal + share * other.normal).normalized();
  if (survivor->weight < other.weight) survivor->weight = other.weight;
}

}  // namespace softscope
