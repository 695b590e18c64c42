// vtk_views/scenes/clip_line.h: clipping of a line to a panel.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace softscope {

/// Cuts a line at the edges of the box [-half, half]; each piece inside it is one line.
std::vector<std::vector<Eigen::Vector2d>> clipLine(const std::vector<Eigen::Vector2d>& line,
                                                   const Eigen::Vector2d& half);

}  // namespace softscope
