// src/stereo/rectification/valid_rectification.h: rectification whose images have no invalid
// pixels.
#pragma once

#include "core/stereo_rig.h"

namespace softscope {

/// stereoRectify with alpha = 0: enlarged until both rectified images are filled, as in the
/// truth of SurgT. Rectified images are unchanged. `Rectifier` keeps the scale instead.
class ValidRectification {
 public:
  explicit ValidRectification(const StereoCalibration& calibration);

  const RectifiedRig& rig() const { return rig_; }
  /// Position of a pixel of the rectified left image in the raw one.
  Eigen::Vector2d rawLeftPixel(const Eigen::Vector2d& rectified_px) const;

 private:
  RectifiedRig rig_;
  RawCamera left_;
  bool rectified_;
};

}  // namespace softscope
