// src/stereo/rectification/rectifier.h: stereo rectification.
#pragma once

#include <memory>

#include "core/image.h"
#include "core/stereo_rig.h"

namespace softscope {

/// Removes lens distortion and the rotation between the cameras (Bouguet's method, as OpenCV has
/// it), so that a point lies in the same row of both images. Images that are rectified already
/// pass unchanged.
class Rectifier {
 public:
  /// Throws InputError where the calibration can't be rectified: no horizontal baseline, or left
  /// and right exchanged.
  explicit Rectifier(const StereoCalibration& calibration);
  ~Rectifier();

  const RectifiedRig& rig() const { return rig_; }

  /// Both images as the rectified cameras would have seen them; black outside the originals.
  /// Throws InputError where their size isn't the calibration's.
  StereoPair rectify(const StereoPair& raw) const;

  /// Where a pixel of the raw left image lies in the rectified one.
  Eigen::Vector2d rectifiedPixel(const Eigen::Vector2d& raw_left_px) const;

  /// A mask of the left image; what the left camera didn't see counts as masked.
  Mask rectifyMask(const Mask& raw) const;

  /// Non-zero where the rectified left pixel lies outside the raw left image; empty if none.
  const Mask& outside() const { return outside_; }
  /// The same of the right view.
  const Mask& outsideRight() const { return outside_right_; }

 private:
  struct Maps;
  RectifiedRig rig_;
  std::unique_ptr<Maps> maps_;  // null where the images are rectified already
  Mask outside_, outside_right_;
};

}  // namespace softscope
