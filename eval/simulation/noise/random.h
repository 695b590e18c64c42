// eval/simulation/noise/random.h: random numbers that are the same on every machine.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace softscope {

/// Mixes 64 bits so that neighbouring inputs give unrelated outputs (SplitMix64's finisher).
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// A stream of numbers that depends on its seed and on nothing else.
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
  /// Unit length, every direction as likely as any other.
  Eigen::Vector3d direction() {
    const double z = uniform(-1, 1), angle_rad = uniform(0, 2 * M_PI), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle_rad), r * std::sin(angle_rad), z};
  }

 private:
  std::uint64_t state_;
};

}  // namespace softscope
