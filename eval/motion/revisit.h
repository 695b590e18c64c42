// eval/motion/revisit.h: errors at revisits of an earlier camera pose.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

struct RevisitOptions {
  double near_mm = 1.5;  // limit of the distance to the earlier position
  double near_deg = 3;   // limit of the rotation
  double away_mm = 3;    // minimum distance reached in between
};

/// Frames at which the camera has returned to an earlier pose.
struct Revisits {
  std::size_t count = 0;
  double first_mm = Statistics::kNone;   // mean error at the first visit
  double again_mm = Statistics::kNone;   // mean error at the revisits
  double growth_mm = Statistics::kNone;  // mean difference per pair
};

/// `world_from_left`: true poses; `error_mm`: one per pose, NaN if
/// unknown (excluded). Each frame is paired with the earliest frame
/// of the same pose. Throws OptionError for different counts.
Revisits revisits(const std::vector<Eigen::Isometry3d>& world_from_left,
                  const std::vector<double>& error_mm, const RevisitOptions& options);

}  // namespace softscope
