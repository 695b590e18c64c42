// eval/simulation/noise/noise.h: smooth and cellular 3-D noise, by arithmetic only.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace softscope {

/// Zero mean, within [-1, 1]; features about one unit wide.
float smoothNoise(const Eigen::Vector3f& position, std::uint32_t seed);

/// Sum of `octaves` smooth noises, each of half wavelength and amplitude; within [-1, 1].
float fractalNoise(const Eigen::Vector3f& position, int octaves, std::uint32_t seed);

/// Three independent smooth noises.
Eigen::Vector3f vectorNoise(const Eigen::Vector3f& position, std::uint32_t seed);

/// Position relative to random seeds, about one seed per unit cube.
struct CellularNoise {
  float nearest;     // distance to the nearest seed
  float second;      // distance to the second nearest seed; equal on the walls of cells
  std::uint32_t id;  // of the nearest seed: 32 random bits
};
CellularNoise cellularNoise(const Eigen::Vector3f& position, std::uint32_t seed);

/// 0 below `low`, 1 above `high`, cubic in between.
inline float smoothStep(float low, float high, float x) {
  float t = (x - low) / (high - low);
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return t * t * (3 - 2 * t);
}

}  // namespace softscope
