// src/calibrate/calibration_quality.h: quality measures of a calibration, and what its images lack.
#pragma once

#include <string>
#include <vector>

#include "calibrate/stereo_solver.h"

namespace softscope {

/// value -+ half_width: where the true value lies in 95 % of calibrations with such noise.
struct ParameterInterval {
  std::string name;  // with its unit: "left.fx_px"
  double value = 0;
  double half_width = 0;
};

/// Of both cameras, of rotation (deg) and translation (mm) of right_from_left, and of the baseline.
/// Unknowns that were not free are left out.
std::vector<ParameterInterval> parameterIntervals(const CalibrationSolution& solution);

/// v_left - v_right after rectification, px: one a pair of pixels of the raw images.
std::vector<double> rowDifferencesPx(const StereoCalibration& calibration,
                                     const std::vector<Eigen::Vector2d>& left_px,
                                     const std::vector<Eigen::Vector2d>& right_px);

inline constexpr int kRegionsAcross = 3, kRegionsDown = 3;

/// Of the corners that both views show.
struct RowErrors {
  double rms_px = 0;  // with the noise of single corners
  /// Mean of each third of the left image in both directions, row by row: what stays without the
  /// noise. NaN with fewer than 10 corners.
  std::vector<double> region_mean_px;
  double worst_region_px = 0;  // the largest magnitude of these; NaN where all are
};
RowErrors rowErrors(const CalibrationSolution& solution);

/// Depth at a distance on the left optical axis.
struct DepthOutlook {
  double distance_mm = 0;
  double sigma_mm = 0;    // by an error of the disparity of `disparity_sigma_px`
  double bias_95_mm = 0;  // the calibration's: a bias of all depths there, less in 95 %
};
DepthOutlook depthOutlook(const CalibrationSolution& solution, double distance_mm,
                          double disparity_sigma_px = 0.25);

inline constexpr int kCellsAcross = 8, kCellsDown = 6;

/// Where in the images corners lie.
struct BoardCoverage {
  std::vector<int> left_counts, right_counts;  // corners per cell, row by row
  double left_share = 0, right_share = 0;      // cells with a corner
};
BoardCoverage boardCoverage(const CalibrationSolution& solution);

/// What further views would help most, a line each; empty where nothing is missing.
std::vector<std::string> whatToFilm(const CalibrationSolution& solution,
                                    const BoardCoverage& coverage);

}  // namespace softscope
