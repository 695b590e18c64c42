// toolkit/calibration/refine_calibration.h: a calibration judged and corrected by a clip of tissue.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "eval/statistics/cohort.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"
#include "toolkit/progress.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct RefineOptions {
  int frames = 40;             // at most, spread over the clip
  int depth_frames = 3;        // of these, whose depth is measured
  int disparity_max_px = 256;  // of rows and depth; cut to half the width

  /// Throws OptionError.
  void validate() const;
};

/// A value and its 95 % interval, bootstrapped over frames; NaN interval for fewer than three.
struct RefinedValue {
  double value = 0;
  Interval interval;
};

/// How the right camera is turned against the calibration, from differences of rows alone: docs/
/// calibrate.md.
struct RefinedCalibration {
  StereoCalibration calibration;                 // the right camera turned by pitch and roll
  int frames = 0, matches = 0;                   // with enough matches; of all of them
  double row_error_px = 0;                       // mean absolute difference of rows, as calibrated
  double row_error_left_px = 0;                  // the same after the correction
  RefinedValue offset_px;                        // v_right - v_left at the principal point
  RefinedValue pitch_mrad, roll_mrad, yaw_mrad;  // of the right camera about x, z, y
  RefinedValue scale_percent;  // focal length of the right rows over the left ones, less 1
  double median_depth_mm = Statistics::kNone;  // of the tissue, after the correction
  double diagonal_view_deg = 0;                // field of view of the rectified image
  std::vector<std::string> doubts;             // why focal length or baseline are implausible
  bool stopped = false;                        // by progress
};

/// Throws InputError where the clip can't be read, or no frame has enough matches.
RefinedCalibration refineCalibration(const SequencePaths& clip, const SequenceOptions& sequence,
                                     const RefineOptions& options, const Progress& progress = {});

/// calibration.yaml with a map `quality`, which readers pass over.
std::string refinedCalibrationText(const RefinedCalibration& refined);
FactSheet refinedCalibrationFacts(const RefinedCalibration& refined);

}  // namespace softscope
