// toolkit/depth/depth_estimator.h: depth of one stereo frame with all outputs of `softscope depth`.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/frame.h"
#include "core/point_cloud.h"
#include "core/stereo_rig.h"
#include "pipeline/frame/frame_depth.h"

namespace softscope {

/// All rasters have the shape of the rectified left image.
struct DepthResult : MeasuredFrame {
  PointCloud cloud;  // mm, in the selected frame
};

class DepthEstimator {
 public:
  /// `raw_left`: the point cloud is in the frame of the raw instead of the rectified left camera.
  DepthEstimator(std::unique_ptr<FrameDepth> depth, std::string backend, bool raw_left)
      : depth_(std::move(depth)), backend_(std::move(backend)), raw_left_(raw_left) {}

  const RectifiedRig& rig() const { return depth_->rig(); }
  /// "cpu" or "cuda".
  const std::string& backend() const { return backend_; }

  /// Throws InputError for a frame that does not fit the calibration.
  DepthResult measure(const Frame& frame);

 private:
  std::unique_ptr<FrameDepth> depth_;
  std::string backend_;
  bool raw_left_;
};

}  // namespace softscope
