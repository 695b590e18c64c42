// apps/depth_estimator.h: one stereo frame to everything that `softscope depth` writes.
#pragma once

#include <memory>

#include "apps/depth_options.h"
#include "core/depth_map.h"
#include "core/frame.h"
#include "core/point_cloud.h"
#include "core/stereo_rig.h"
#include "stereo/rectifier.h"
#include "stereo/row_alignment.h"
#include "stereo/stereo_matcher.h"

namespace softscope {

/// All rasters have the shape of the rectified left picture.
struct MeasuredFrame {
  ColourImage left;        // rectified
  Mask mask;               // instruments, and what the raw left picture didn't show; may be empty
  DisparityMap disparity;  // empty where depth came from a file
  DepthMap depth;
  PointCloud cloud;   // mm, in the frame asked for
  RowAlignment rows;  // as found after rectification
  bool rows_aligned = false;
  StageTimes times;
};

class DepthEstimator {
 public:
  /// `raw_left`: the cloud is turned from the rectified into the raw left camera's frame.
  DepthEstimator(const StereoCalibration& calibration, const DepthOptions& options, bool raw_left);

  const RectifiedRig& rig() const { return rectifier_.rig(); }
  std::string method() const;  // elas, sgbm or files

  /// Throws InputError where the frame doesn't fit.
  MeasuredFrame measure(const Frame& frame);

 private:
  void match(const Frame& frame, MeasuredFrame& measured);
  void takeFile(const Frame& frame, MeasuredFrame& measured) const;
  void dropMasked(MeasuredFrame& measured) const;

  DepthOptions options_;
  bool raw_left_;
  Rectifier rectifier_;
  std::unique_ptr<StereoMatcher> matcher_;
};

}  // namespace softscope
