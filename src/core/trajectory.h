// src/core/trajectory.h: poses of the scope over time.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace softscope {

struct TimedPose {
  double time_s = 0;
  /// p_world = world_from_left * p_left, mm.
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
};

/// In the order of time.
using Trajectory = std::vector<TimedPose>;

}  // namespace softscope
