// src/calibrate/stereo_solver.h: from the corners of a board to a stereo calibration.
#pragma once

#include <vector>

#include "calibrate/bundle.h"
#include "calibrate/view_choice.h"
#include "core/stereo_rig.h"

namespace softscope {

struct SolveOptions {
  BundleOptions bundle;
  double misfit_ratio = 3;  // a view whose RMS exceeds this times the median is left out

  /// Throws OptionError.
  void validate() const;
};

struct SolvedView {
  int frame = 0;
  double rms_px = 0;
  double tilt_deg = 0;     // of the board against the image plane
  double distance_mm = 0;  // of the board's middle, along the optical axis
};

struct CalibrationSolution {
  BundleState state;  // one view per entry of `views`
  BundleSummary summary;
  std::vector<SolvedView> views;
  std::vector<LeftOutView> left_out;  // views that did not fit
  int corners_left_out = 0;           // single corners that did not fit

  /// Lengths in mm; not rectified.
  StereoCalibration calibration() const;
};

inline constexpr int kLeastViews = 3;

/// Each camera by itself (calib3d's calibrateCamera), then everything jointly; then once more
/// without what did not fit. Throws InputError for fewer than three views, and where these do not
/// determine the cameras.
CalibrationSolution solveStereo(const std::vector<BoardSighting>& sightings,
                                const BoardOptions& board, int width_px, int height_px,
                                const SolveOptions& options = {});

}  // namespace softscope
