// vtk_views/scenes/clip_line.cpp: Liang-Barsky clipping per segment.
#include "vtk_views/scenes/clip_line.h"

#include <algorithm>
#include <cstddef>

namespace softscope {
namespace {

/// Parameters of entry and exit of the segment; false if it is outside.
bool insideShares(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& half,
                  double& enter, double& leave) {
  enter = 0;
  leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = b[axis] - a[axis];
    if (step == 0) {
      if (a[axis] < -half[axis] || a[axis] > half[axis]) return false;
      continue;
    }
    const double t0 = (-half[axis] - a[axis]) / step, t1 = (half[axis] - a[axis]) / step;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter <= leave;
}

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> clipLine(const std::vector<Eigen::Vector2d>& line,
                                                   const Eigen::Vector2d& half) {
  std::vector<std::vector<Eigen::Vector2d>> pieces;
  bool open = false;  // the last piece ends at the start of this segment
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    double enter = 0, leave = 1;
    if (!insideShares(line[i], line[i + 1], half, enter, leave)) {
      open = false;
      continue;
    }
    const Eigen::Vector2d step = line[i + 1] - line[i];
    if (!open) pieces.push_back({line[i] + enter * step});
    pieces.back().push_back(line[i] + leave * step);
    open = leave == 1;
  }
  return pieces;
}

}  // namespace softscope
