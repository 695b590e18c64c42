// src/features/connected_surface.h: the part of the image that shows the surface of one
// pixel.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/depth_map.h"

namespace softscope {

/// Pixels around one that are connected with it by measured depth without a step. What lies behind
/// a contour, or has no depth, is not among them: a contour moves over the tissue with the scope.
class ConnectedSurface {
 public:
  /// Within `reach_px` of the pixel, or of the nearest one with depth. A step is a slope of more
  /// than four, depth over width, beyond the predicted error; `focal_px` of the depth's camera.
  ConnectedSurface(const DepthMap& depth, const Eigen::Vector2d& pixel, double focal_px,
                   int reach_px);
  /// Whether all pixels within `margin_px` of the nearest one belong to it.
  bool holds(const Eigen::Vector2d& pixel, int margin_px) const;
  /// False without depth near the pixel.
  bool found() const { return !sums_.empty(); }

 private:
  int u0_ = 0, v0_ = 0, side_ = 0;
  std::vector<int> sums_;  // of connected pixels above and left of each corner, (side + 1)^2
};

}  // namespace softscope
