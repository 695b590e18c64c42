// src/calibrate/row_outlook.h: expected error of rows all over the image.
#pragma once

#include <Eigen/Core>

#include "calibrate/stereo_solver.h"

namespace softscope {

/// Standard deviation of v_left - v_right after rectification, px, for a point in the left camera's
/// frame: the calibration's own uncertainty, to first order; the noise of a match is not in it.
double rowSigmaPx(const CalibrationSolution& solution, const Eigen::Vector3d& point_left_mm);

/// Half widths of 95 % intervals of the row error, px, on a grid over the left image at the median
/// distance of the boards, where the right camera sees the point too. NaN where none does.
struct RowOutlook {
  double distance_mm = 0;
  double median_95_px = 0;
  double worst_95_px = 0;
  Eigen::Vector2d worst_at_px = Eigen::Vector2d::Zero();  // in the raw left image
};
RowOutlook rowOutlook(const CalibrationSolution& solution);

}  // namespace softscope
