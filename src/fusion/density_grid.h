// src/fusion/density_grid.h: merging of points that are denser than the point spacing.
#pragma once

#include <cstdint>
#include <vector>

#include "core/point_model.h"
#include "fusion/fusion_options.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// New indices of points after removals.
struct IndexMap {
  static constexpr std::int32_t kRemoved = -1;
  std::vector<std::int32_t> new_of_old;  // merged points map to their replacement
  std::int32_t new_count = 0;

  bool identity() const { return static_cast<std::size_t>(new_count) == new_of_old.size(); }
};

/// Keeps one point per cell and side of the surface: docs/fusion.md (F17), (F18).
/// The one with the largest weight is kept, so that material points do not slide,
/// with an averaged height over the surface. Points without weight, and those
/// without a finite position or a normal, are removed. The others keep their order.
/// Cells are smaller near the camera. Throws OptionError for invalid options.
IndexMap keepDensity(const DensityOptions& options, const PosedCamera& camera, PointModel* model);

}  // namespace softscope
