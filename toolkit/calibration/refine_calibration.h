// toolkit/calibration/refine_calibration.h: check and correction of a calibration on tissue.
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
  int frames = 40;             // upper limit; evenly spread over the clip
  int depth_frames = 3;        // subset with measured depth
  int disparity_max_px = 256;  // for vertical disparity and depth; limited to half of the width

  /// Throws OptionError.
  void validate() const;
};

/// Value with 95 % interval, bootstrapped over frames; NaN interval for fewer than three frames.
struct RefinedValue {
  double value = 0;
  Interval interval;
};

/// Rotation of the right camera relative to the calibration,
/// from vertical disparity alone: docs/calibrate.md.
struct RefinedCalibration {
  StereoCalibration calibration;                 // right camera corrected by pitch and roll
  int frames = 0, matches = 0;                   // frames with enough matches; all matches
  double row_error_px = 0;                       // mean absolute vertical disparity, before
  double row_error_left_px = 0;                  // the same after the correction
  RefinedValue offset_px;                        // v_right - v_left at the principal point
  RefinedValue pitch_mrad, roll_mrad, yaw_mrad;  // right camera about x, z, y
  RefinedValue scale_percent;                    // vertical focal length, right over left, minus 1
  double median_depth_mm = Statistics::kNone;    // of the tissue, after the correction
  double diagonal_view_deg = 0;                  // of the rectified image
  std::vector<std::string> doubts;               // reasons for implausible focal length or baseline
  bool stopped = false;                          // by progress
};

/// Throws InputError for an unreadable clip, or if no frame has enough matches.
RefinedCalibration refineCalibration(const SequencePaths& clip, const SequenceOptions& sequence,
                                     const RefineOptions& options, const Progress& progress = {});

/// calibration.yaml with an additional map `quality`, which readers ignore.
std::string refinedCalibrationText(const RefinedCalibration& refined);
FactSheet refinedCalibrationFacts(const RefinedCalibration& refined);

}  // namespace softscope
