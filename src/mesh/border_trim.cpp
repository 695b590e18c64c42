// src/mesh/border_trim.cpp: neighbours by sorted sides, iterative removal.
#include "mesh/border_trim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace softscope {
namespace {

constexpr std::int32_t kNoSide = -1;

/// Neighbour at each side, from corner k to the next.
using Neighbours = std::vector<std::array<std::int32_t, 3>>;

struct TriangleSide {
  std::int32_t low, high;  // points
  std::int32_t triangle, k;
};

Neighbours neighboursOf(const std::vector<Triangle>& triangles) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), std::int32_t(i), std::int32_t(k)});
    }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  Neighbours beyond(triangles.size(), {kNoSide, kNoSide, kNoSide});
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const TriangleSide &one = sides[i - 1], &other = sides[i];
    if (one.low != other.low || one.high != other.high) continue;
    beyond[std::size_t(one.triangle)][std::size_t(one.k)] = other.triangle;
    beyond[std::size_t(other.triangle)][std::size_t(other.k)] = one.triangle;
  }
  return beyond;
}

/// Of the angle at corner k.
double cosineAt(const std::vector<Eigen::Vector3f>& positions_mm, const Triangle& t,
                std::size_t k) {
  const Eigen::Vector3f& tip = positions_mm[std::size_t(t[k])];
  const Eigen::Vector3f one = positions_mm[std::size_t(t[(k + 1) % 3])] - tip;
  const Eigen::Vector3f other = positions_mm[std::size_t(t[(k + 2) % 3])] - tip;
  return double(one.dot(other)) / std::max(double(one.norm() * other.norm()), 1e-30);
}

}  // namespace

std::vector<Triangle> withoutSplinters(const std::vector<Eigen::Vector3f>& positions_mm,
                                       const std::vector<Triangle>& triangles,
                                       double sharpest_deg) {
  const double sharpest = std::cos(sharpest_deg * 3.14159265358979323846 / 180);
  Neighbours beyond = neighboursOf(triangles);
  std::vector<char> kept(triangles.size(), 1);
  const auto isSplinter = [&](std::size_t i) {
    const auto& sides = beyond[i];
    const auto held = std::find_if(sides.begin(), sides.end(), [](auto t) { return t != kNoSide; });
    if (held == sides.end()) return true;
    if (std::count(sides.begin(), sides.end(), kNoSide) < 2) return false;
    const auto tip = std::size_t(held - sides.begin() + 2) % 3;  // opposite to the only shared side
    return cosineAt(positions_mm, triangles[i], tip) > sharpest;
  };
  std::vector<std::int32_t> suspects;
  for (std::size_t i = triangles.size(); i-- > 0;) suspects.push_back(std::int32_t(i));
  while (!suspects.empty()) {
    const auto i = std::size_t(suspects.back());
    suspects.pop_back();
    if (!kept[i] || !isSplinter(i)) continue;
    kept[i] = 0;
    for (const std::int32_t neighbour : beyond[i]) {
      if (neighbour == kNoSide) continue;
      for (std::int32_t& back : beyond[std::size_t(neighbour)])
        if (back == std::int32_t(i)) back = kNoSide;
      suspects.push_back(neighbour);
    }
  }
  std::vector<Triangle> left;
  left.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (kept[i]) left.push_back(triangles[i]);
  return left;
}

}  // namespace softscope
