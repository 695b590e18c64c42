// eval/motion/revisit.cpp: comparison of every frame with every earlier one.
#include "eval/motion/revisit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"

namespace softscope {
namespace {

using Poses = std::vector<Eigen::Isometry3d>;

double apart_mm(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

bool isBack(const Eigen::Isometry3d& then, const Eigen::Isometry3d& now,
            const RevisitOptions& options) {
  const double angle_rad = Eigen::AngleAxisd(then.linear().transpose() * now.linear()).angle();
  return apart_mm(then, now) <= options.near_mm && angle_rad * 180 / M_PI <= options.near_deg;
}

/// Earliest frame with an error at the camera pose of frame `now`.
std::optional<std::size_t> firstVisit(const Poses& poses, const std::vector<double>& error_mm,
                                      std::size_t now, const RevisitOptions& options) {
  for (std::size_t then = 0; then + 1 < now; ++then) {
    if (!std::isfinite(error_mm[then]) || !isBack(poses[then], poses[now], options)) continue;
    const auto away = [&](const Eigen::Isometry3d& p) {
      return apart_mm(p, poses[then]) >= options.away_mm;
    };
    if (std::any_of(poses.begin() + std::ptrdiff_t(then), poses.begin() + std::ptrdiff_t(now),
                    away))
      return then;
  }
  return std::nullopt;
}

}  // namespace

Revisits revisits(const Poses& world_from_left, const std::vector<double>& error_mm,
                  const RevisitOptions& options) {
  if (world_from_left.size() != error_mm.size())
    throw OptionError("revisits: poses and errors must be equally many");
  std::vector<double> first, again, growth;
  for (std::size_t now = 2; now < error_mm.size(); ++now) {
    if (!std::isfinite(error_mm[now])) continue;
    const auto then = firstVisit(world_from_left, error_mm, now, options);
    if (!then) continue;
    first.push_back(error_mm[*then]);
    again.push_back(error_mm[now]);
    growth.push_back(again.back() - first.back());
  }
  return {first.size(), statistics(first).mean, statistics(again).mean, statistics(growth).mean};
}

}  // namespace softscope
