// src/core/farthest.h: limit of plausible coordinates.
#pragma once

namespace softscope {

/// Largest coordinate of a point or a pose in a file: 1 km.
inline constexpr double kFarthestMm = 1e6;

}  // namespace softscope
