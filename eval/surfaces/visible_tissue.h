// eval/surfaces/visible_tissue.h: visible tissue
// according to the true depth of the left image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/raster.h"
#include "core/stereo_rig.h"

namespace softscope {

struct TissueSampling {
  int step_px = 4;    // grid spacing in columns and rows, from pixel (0, 0)
  int margin_px = 8;  // tissue within this distance of the image border is excluded

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Points of the true surface on a grid of left
/// pixels, mm, in the left camera frame, row by row.
struct TissueSamples {
  std::vector<Eigen::Vector3f> points_left_mm;  // all visible to the left camera
  /// One per point: non-zero inside both images, margin_px from the border
  /// of the left image and from the left border of the right image.
  std::vector<std::uint8_t> in_both;
};

/// `depth_mm`: true depth of the left image, NaN = none.
/// Throws InputError for another size than that of the camera.
TissueSamples sampleVisibleTissue(const Raster<float>& depth_mm, const RectifiedRig& rig,
                                  const TissueSampling& sampling = {});

/// True if the left camera sees a point of the true surface (in its frame, mm): it is
/// inside the image, and not more than `slack_mm` behind all four neighbouring pixels.
bool isSurfacePointVisible(const Raster<float>& depth_mm, const PinholeCamera& left,
                           const Eigen::Vector3d& point_left_mm, double slack_mm = 0.2);

}  // namespace softscope
