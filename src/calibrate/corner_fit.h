// src/calibrate/corner_fit.h: sub-pixel corner of a checkerboard by least squares on grey levels.
#pragma once

#include <Eigen/Core>

#include "core/image.h"

namespace softscope {

/// Initial estimate of the intersection of four squares.
struct CornerStart {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  /// Directions of rows and columns of the board; any length, either sign.
  Eigen::Vector2d along_row = Eigen::Vector2d::UnitX(), along_column = Eigen::Vector2d::UnitY();
};

/// Fits m + g (q - p) + c erf(n1 (q - p) / (√2 s)) erf(n2 (q - p) / (√2
/// s)) to the grey levels of pixels q within `reach_px`: corner p,
/// normals n1, n2 of both edges, blur s, contrast c, level m and its
/// slope g. Returns p, or the start if the fit does not converge near it.
Eigen::Vector2d fitCorner(const GrayImage& image, const CornerStart& start, int reach_px);

}  // namespace softscope
