// src/calibrate/row_outlook.h: expected vertical disparity over the whole image.
#pragma once

#include <Eigen/Core>

#include "calibrate/stereo_solver.h"

namespace softscope {

/// Standard deviation of v_left - v_right after rectification, px, for a point in the left
/// camera frame: uncertainty of the calibration to first order, without the noise of a match.
double rowSigmaPx(const CalibrationSolution& solution, const Eigen::Vector3d& point_left_mm);

/// Half widths of 95 % intervals of the vertical disparity, px, on a grid over the left image at
/// the median distance of the boards, for points visible to the right camera. NaN without any.
struct RowOutlook {
  double distance_mm = 0;
  double median_95_px = 0;
  double worst_95_px = 0;
  Eigen::Vector2d worst_at_px = Eigen::Vector2d::Zero();  // in the raw left image
};
RowOutlook rowOutlook(const CalibrationSolution& solution);

}  // namespace softscope
