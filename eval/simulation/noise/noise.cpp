// eval/simulation/noise/noise.cpp: gradient noise (Perlin 2002) and cellular noise (Worley 1996).
#include "eval/simulation/noise/noise.h"

#include <cmath>
#include <limits>

namespace softscope {
namespace {

std::uint32_t hashCell(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9e3779b1u;
  h ^= static_cast<std::uint32_t>(x) * 0x85ebca77u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h ^= static_cast<std::uint32_t>(y) * 0xc2b2ae3du;
  h = (h ^ (h >> 13)) * 0x297a2d39u;
  h ^= static_cast<std::uint32_t>(z) * 0x27d4eb2fu;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  return h ^ (h >> 15);
}

/// Dot product of `offset` with one of the twelve directions to the edges of a cube.
float edgeGradient(std::uint32_t hash, float x, float y, float z) {
  const std::uint32_t h = hash & 15u;
  const float u = h < 8 ? x : y;
  const float v = h < 4 ? y : (h == 12 || h == 14 ? x : z);
  return ((h & 1u) ? -u : u) + ((h & 2u) ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float mix(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

float smoothNoise(const Eigen::Vector3f& position, std::uint32_t seed) {
  const float fx = std::floor(position.x()), fy = std::floor(position.y()),
              fz = std::floor(position.z());
  const int x = static_cast<int>(fx), y = static_cast<int>(fy), z = static_cast<int>(fz);
  const float px = position.x() - fx, py = position.y() - fy, pz = position.z() - fz;
  const auto corner = [&](int i, int j, int k) {
    return edgeGradient(hashCell(x + i, y + j, z + k, seed), px - float(i), py - float(j),
                        pz - float(k));
  };
  const float u = fade(px), v = fade(py), w = fade(pz);
  const float front =
      mix(mix(corner(0, 0, 0), corner(1, 0, 0), u), mix(corner(0, 1, 0), corner(1, 1, 0), u), v);
  const float back =
      mix(mix(corner(0, 0, 1), corner(1, 0, 1), u), mix(corner(0, 1, 1), corner(1, 1, 1), u), v);
  return mix(front, back, w);
}

float fractalNoise(const Eigen::Vector3f& position, int octaves, std::uint32_t seed) {
  float sum = 0, strength = 1, total = 0;
  Eigen::Vector3f p = position;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += strength * smoothNoise(p, seed + static_cast<std::uint32_t>(octave) * 101u);
    total += strength;
    strength *= 0.5F;
    p = 2.03F * p;  // not 2: avoids coincident lattices of the octaves
  }
  return sum / total;
}

Eigen::Vector3f vectorNoise(const Eigen::Vector3f& position, std::uint32_t seed) {
  return {smoothNoise(position, seed), smoothNoise(position, seed + 7919u),
          smoothNoise(position, seed + 15838u)};
}

CellularNoise cellularNoise(const Eigen::Vector3f& position, std::uint32_t seed) {
  const int x = static_cast<int>(std::floor(position.x())),
            y = static_cast<int>(std::floor(position.y())),
            z = static_cast<int>(std::floor(position.z()));
  float nearest2 = std::numeric_limits<float>::max(), second2 = nearest2;
  std::uint32_t id = 0;
  for (int i = x - 1; i <= x + 1; ++i)
    for (int j = y - 1; j <= y + 1; ++j)
      for (int k = z - 1; k <= z + 1; ++k) {
        const std::uint32_t hash = hashCell(i, j, k, seed);
        const float dx = float(i) + float(hash & 1023u) / 1024 - position.x();
        const float dy = float(j) + float((hash >> 10) & 1023u) / 1024 - position.y();
        const float dz = float(k) + float((hash >> 20) & 1023u) / 1024 - position.z();
        const float distance2 = dx * dx + dy * dy + dz * dz;
        if (distance2 < nearest2) {
          second2 = nearest2;
          nearest2 = distance2;
          id = hash;
        } else if (distance2 < second2) {
          second2 = distance2;
        }
      }
  return {std::sqrt(nearest2), std::sqrt(second2), id};
}

}  // namespace softscope
