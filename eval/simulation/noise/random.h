// eval/simulation/noise/random.h: portable pseudo-random numbers.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace softscope {

/// 64-bit hash (finaliser of SplitMix64).
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Pseudo-random sequence, determined by its seed.
class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : state_(mixBits(seed)) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ull;
    return mixBits(state_);
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  int below(int count) { return static_cast<int>(uniform() * count); }
  /// Uniformly distributed unit vector.
  Eigen::Vector3d direction() {
    const double z = uniform(-1, 1), angle_rad = uniform(0, 2 * M_PI), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle_rad), r * std::sin(angle_rad), z};
  }

 private:
  std::uint64_t state_;
};

}  // namespace softscope
