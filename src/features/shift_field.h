// src/features/shift_field.h: predicted shift of every pixel, interpolated from sparse matches.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/raster.h"
#include "features/matcher.h"

namespace softscope {

/// Smooth field of shifts over the model image. Squares without a match get the mean of
/// the smallest surrounding block with one (push-pull interpolation; Gortler et al. 1996).
class ShiftField {
 public:
  /// Zero shift.
  ShiftField() = default;
  /// Mean shift of the matches in squares of `square_px`; `width_px` x
  /// `height_px` is the size of the model image. Without matches: zero shift.
  ShiftField(const std::vector<PixelMatch>& matches, int width_px, int height_px, int square_px);

  /// px; bilinear between the centres of the squares.
  Eigen::Vector2f at(const Eigen::Vector2f& model_px) const;

 private:
  int square_px_ = 1;
  Raster<Eigen::Vector2f> shift_px_;  // one per square; empty = no shift
};

}  // namespace softscope
