// src/stereo/rectification/rectifier.h: stereo rectification.
#pragma once

#include <memory>

#include "core/image.h"
#include "core/stereo_rig.h"
#include "stereo/images/view_masks.h"

namespace softscope {

/// Removes lens distortion and the rotation between the cameras
/// (Bouguet's method in OpenCV), so that a point is in the same
/// row of both images. Rectified images are unchanged.
class Rectifier {
 public:
  /// Throws InputError for a calibration that cannot be rectified:
  /// no horizontal baseline, or left and right exchanged.
  explicit Rectifier(const StereoCalibration& calibration);
  ~Rectifier();

  const RectifiedRig& rig() const { return rig_; }

  /// Both images as seen by the rectified cameras; black outside of the originals.
  /// Throws InputError for images that are not of the size of the calibration.
  StereoPair rectify(const StereoPair& raw) const;

  /// Position of a pixel of the raw left image in the rectified one.
  Eigen::Vector2d rectifiedPixel(const Eigen::Vector2d& raw_left_px) const;

  /// A mask of the left image; pixels outside of the raw left image count as masked.
  Mask rectifyMask(const Mask& raw) const;

  /// Non-zero for rectified pixels outside of the raw image; empty for rectified images.
  const ViewMasks& outside() const { return outside_; }
  /// Of which the outside has a share, too.
  const ViewMasks& mixedWithOutside() const { return mixed_with_outside_; }

 private:
  struct Maps;
  RectifiedRig rig_;
  std::unique_ptr<Maps> maps_;  // null for rectified images
  ViewMasks outside_, mixed_with_outside_;
};

}  // namespace softscope
