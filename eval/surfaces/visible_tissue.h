// eval/surfaces/visible_tissue.h: which tissue the cameras see, by the true depth of the left
// image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/raster.h"
#include "core/stereo_rig.h"

namespace softscope {

struct TissueSampling {
  int step_px = 4;    // every so many columns and rows, from pixel (0, 0)
  int margin_px = 8;  // tissue nearer to an image's border than this can't be asked for

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// Points of the true surface on a grid of pixels of the left image, mm, in the left camera's
/// frame, row by row.
struct TissueSamples {
  std::vector<Eigen::Vector3f> points_left_mm;  // all that the left camera sees
  /// One a point: non-zero where it lies inside both images, margin_px from the left one's border
  /// and from the right one's left border.
  std::vector<std::uint8_t> in_both;
};

/// `depth_mm`: true depth of the left image, NaN = none. Throws InputError unless it has the
/// camera's size.
TissueSamples sampleVisibleTissue(const Raster<float>& depth_mm, const RectifiedRig& rig,
                                  const TissueSampling& sampling = {});

/// Whether the left camera sees a point of the true surface, given in its frame, mm: it lies in the
/// image and nothing there is nearer by more than `slack_mm` than all four pixels around it.
bool seesSurfacePoint(const Raster<float>& depth_mm, const PinholeCamera& left,
                      const Eigen::Vector3d& point_left_mm, double slack_mm = 0.2);

}  // namespace softscope
