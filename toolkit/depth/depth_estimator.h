// toolkit/depth/depth_estimator.h: one stereo frame to everything that `softscope depth` writes.
#pragma once

#include "core/frame.h"
#include "core/point_cloud.h"
#include "core/stereo_rig.h"
#include "pipeline/frame_depth.h"
#include "pipeline/run_options.h"

namespace softscope {

/// All rasters have the shape of the rectified left picture.
struct DepthResult : MeasuredFrame {
  PointCloud cloud;  // mm, in the frame asked for
};

class DepthEstimator {
 public:
  /// `raw_left`: the cloud is turned from the rectified into the raw left camera's frame.
  DepthEstimator(const StereoCalibration& calibration, const DepthOptions& options, bool raw_left)
      : depth_(calibration, options.measurement), raw_left_(raw_left) {}

  const RectifiedRig& rig() const { return depth_.rig(); }

  /// Throws InputError where the frame doesn't fit.
  DepthResult measure(const Frame& frame);

 private:
  FrameDepth depth_;
  bool raw_left_;
};

}  // namespace softscope
