// vtk_views/scenes/clip_line.h: clipping of a line to a panel.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace softscope {

/// Clips a line to the box [-half, half]; returns the pieces inside.
std::vector<std::vector<Eigen::Vector2d>> clipLine(const std::vector<Eigen::Vector2d>& line,
                                                   const Eigen::Vector2d& half);

}  // namespace softscope
