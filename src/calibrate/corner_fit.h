// src/calibrate/corner_fit.h: a checkerboard's corner by least squares on the image's levels.
#pragma once

#include <Eigen/Core>

#include "core/image.h"

namespace softscope {

/// Where four squares meet, from near it.
struct CornerStart {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  /// Along the board's rows and columns there; any length, either sign.
  Eigen::Vector2d along_row = Eigen::Vector2d::UnitX(), along_column = Eigen::Vector2d::UnitY();
};

/// Fits m + g (q - p) + c erf(n1 (q - p) / (√2 s)) erf(n2 (q - p) / (√2 s)) to the levels of the
/// pixels q within `reach_px`: the corner p, the normals n1, n2 of both edges, the edges' blur s,
/// contrast c, level m and its slope g. Returns p; the start where the fit does not converge near
/// it.
Eigen::Vector2d fitCorner(const GrayImage& image, const CornerStart& start, int reach_px);

}  // namespace softscope
