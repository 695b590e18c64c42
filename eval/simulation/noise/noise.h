// eval/simulation/noise/noise.h: smooth and cellular noise in space, by arithmetic alone.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace softscope {

/// Smooth, zero on average, within [-1, 1]; features about one unit wide.
float smoothNoise(const Eigen::Vector3f& position, std::uint32_t seed);

/// Sum of `octaves` smooth noises, each half as wide and half as strong; within [-1, 1].
float fractalNoise(const Eigen::Vector3f& position, int octaves, std::uint32_t seed);

/// Three independent smooth noises.
Eigen::Vector3f vectorNoise(const Eigen::Vector3f& position, std::uint32_t seed);

/// Where a position lies among random seeds, about one a unit cube.
struct CellularNoise {
  float nearest;     // distance to the closest seed
  float second;      // and to the next one; the two agree on the walls between cells
  std::uint32_t id;  // of the closest seed: 32 random bits
};
CellularNoise cellularNoise(const Eigen::Vector3f& position, std::uint32_t seed);

/// 0 below `low`, 1 above `high`, a cubic in between.
inline float smoothStep(float low, float high, float x) {
  float t = (x - low) / (high - low);
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return t * t * (3 - 2 * t);
}

}  // namespace softscope
