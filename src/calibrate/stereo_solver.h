// src/calibrate/stereo_solver.h: stereo calibration from detected corners.
#pragma once

#include <vector>

#include "calibrate/bundle.h"
#include "calibrate/view_choice.h"
#include "core/stereo_rig.h"

namespace softscope {

struct SolveOptions {
  BundleOptions bundle;
  double misfit_ratio = 3;  // a view with an RMS above this multiple of the median is rejected

  /// Throws OptionError.
  void validate() const;
};

struct SolvedView {
  int frame = 0;
  double rms_px = 0;
  double tilt_deg = 0;     // of the board relative to the image plane
  double distance_mm = 0;  // of the centre of the board, along the optical axis
};

struct CalibrationSolution {
  BundleState state;  // one view per entry of `views`
  BundleSummary summary;
  std::vector<SolvedView> views;
  std::vector<LeftOutView> left_out;  // rejected views
  int corners_left_out = 0;           // number of rejected corners

  /// Lengths in mm; not rectified.
  StereoCalibration calibration() const;
};

inline constexpr int kLeastViews = 3;

/// Calibrates each camera (calibrateCamera of calib3d), then both
/// jointly; then again without rejected data. Throws InputError for
/// fewer than three views, and if they do not determine the cameras.
CalibrationSolution solveStereo(const std::vector<BoardSighting>& sightings,
                                const BoardOptions& board, int width_px, int height_px,
                                const SolveOptions& options = {});

}  // namespace softscope
