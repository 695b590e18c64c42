// src/calibrate/calibration_quality.h: quality of a calibration, advice for more views.
#pragma once

#include <string>
#include <vector>

#include "calibrate/stereo_solver.h"

namespace softscope {

/// value -+ half_width: 95 % confidence interval for the observed noise.
struct ParameterInterval {
  std::string name;  // with its unit: "left.fx_px"
  double value = 0;
  double half_width = 0;
};

/// For both cameras, rotation (deg) and translation (mm) of
/// right_from_left, and the baseline; without fixed unknowns.
std::vector<ParameterInterval> parameterIntervals(const CalibrationSolution& solution);

/// v_left - v_right after rectification, px: one per pair of raw pixels.
std::vector<double> rowDifferencesPx(const StereoCalibration& calibration,
                                     const std::vector<Eigen::Vector2d>& left_px,
                                     const std::vector<Eigen::Vector2d>& right_px);

inline constexpr int kRegionsAcross = 3, kRegionsDown = 3;

/// Over corners detected in both views.
struct RowErrors {
  double rms_px = 0;  // including the noise of single corners
  /// Mean in each ninth of the left image, row by row: systematic
  /// error without noise. NaN with fewer than 10 corners.
  std::vector<double> region_mean_px;
  double worst_region_px = 0;  // largest magnitude of these; NaN if all are NaN
};
RowErrors rowErrors(const CalibrationSolution& solution);

/// Depth at a distance on the left optical axis.
struct DepthOutlook {
  double distance_mm = 0;
  double sigma_mm = 0;    // for a disparity error of `disparity_sigma_px`
  double bias_95_mm = 0;  // systematic error of all depths there by the calibration, 95 % bound
};
DepthOutlook depthOutlook(const CalibrationSolution& solution, double distance_mm,
                          double disparity_sigma_px = 0.25);

inline constexpr int kCellsAcross = 8, kCellsDown = 6;

/// Coverage of the images by corners.
struct BoardCoverage {
  std::vector<int> left_counts, right_counts;  // corners per cell, row by row
  double left_share = 0, right_share = 0;      // share of cells with a corner
};
BoardCoverage boardCoverage(const CalibrationSolution& solution);

/// Most useful further views, one line each; empty if none is missing.
std::vector<std::string> imagingAdvice(const CalibrationSolution& solution,
                                       const BoardCoverage& coverage);

}  // namespace softscope
