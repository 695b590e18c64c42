// eval/motion/revisit.h: errors when the scope returns to tissue seen before.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

struct RevisitOptions {
  double near_mm = 1.5;  // this near to where it was, and
  double near_deg = 3;   // turned by no more, the scope is back,
  double away_mm = 3;    // if it was this far away in between
};

/// Moments at which the scope is back where it was.
struct Revisits {
  std::size_t count = 0;
  double first_mm = Statistics::kNone;   // mean error at the first visit
  double again_mm = Statistics::kNone;   // mean error at the moments when it was back
  double growth_mm = Statistics::kNone;  // mean of again minus first, pair by pair
};

/// `world_from_left`: true poses; `error_mm`: one a pose, NaN where there is none (no such moment
/// takes part). Each moment is paired with the earliest one that it comes back to. Throws
/// OptionError where the numbers differ.
Revisits revisits(const std::vector<Eigen::Isometry3d>& world_from_left,
                  const std::vector<double>& error_mm, const RevisitOptions& options);

}  // namespace softscope
