// tests/cuda/view_cases.h: models whose view on the GPU must have the CPU's bytes.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "core/point_model.h"
#include "features/model_view.h"

namespace softscope::test {

/// A model, a camera and its pose.
struct ViewCase {
  const char* name;
  int width, height;
  double focal_px;
  int points;
  Eigen::Isometry3d world_from_left;
  int gap_px;
};

inline Eigen::Isometry3d poseAt(double x, double y, double z, double turn_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

inline std::vector<ViewCase> viewCases() {
  return {{"tilted", 171, 131, 140, 9000, poseAt(2, 1, 4, 0.2), 4},
          {"near", 96, 80, 200, 2500, poseAt(0, 0, 40, 0), 4},     // large discs
          {"far", 64, 48, 50, 20000, poseAt(-3, 2, -60, 0.1), 1},  // many discs in a pixel
          {"sparse", 120, 90, 220, 1500, poseAt(0, 1, 0, 0), 9},   // gaps, some bridged
          {"noGaps", 120, 90, 100, 4000, poseAt(0, 1, 0, -0.1), 0},
          {"behind", 40, 30, 40, 300, poseAt(0, 0, 200, 0), 4}};  // nothing is seen
}

inline PinholeCamera cameraOf(const ViewCase& of) {
  return {of.width,
          of.height,
          of.focal_px,
          1.02 * of.focal_px,
          of.width / 2.0 + 0.3,
          of.height / 2.0 - 0.2};
}

/// A wavy surface and a second one before it; some points lack a normal or a place, some turn away.
inline PointModel modelOf(const ViewCase& of) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> in(-1, 1);
  PointModel model;
  for (int i = 0; i < of.points; ++i) {
    Eigen::Vector3f p(25 * in(random), 20 * in(random), 0);
    p.z() = 60 + 0.3f * p.x() + 3 * std::sin(p.x() / 3) * std::cos(p.y() / 4);
    if (i % 3 == 0 && p.x() > 0) p.z() -= 6;
    if (i % 101 == 0) p.x() = std::numeric_limits<float>::quiet_NaN();
    Eigen::Vector3f normal(0.3f + 0.5f * in(random), 0.4f * in(random), i % 23 == 0 ? 1.0f : -1.0f);
    normal = i % 50 == 0 ? Eigen::Vector3f(0, 0, 0) : Eigen::Vector3f(normal / normal.norm());
    const auto gray = static_cast<std::uint8_t>(128 + 100 * in(random));
    model.add(p, normal, {gray, static_cast<std::uint8_t>(i), 90}, 1);
    model.anchors.back() = static_cast<std::uint8_t>(7 * i);
  }
  return model;
}

/// How many pixels differ in a bit, NaN alike.
inline int differingPixels(const ModelView& a, const ModelView& b) {
  if (!a.colour.sameShape(b.colour)) return -1;
  int count = 0;
  for (std::size_t i = 0; i < a.colour.size(); ++i) {
    const float x = a.depth_mm.values[i], y = b.depth_mm.values[i];
    const bool both_nan = std::isnan(x) && std::isnan(y);
    count += !(a.colour.values[i] == b.colour.values[i]) ||
             a.anchor.values[i] != b.anchor.values[i] ||
             a.point_index.values[i] != b.point_index.values[i] ||
             (!both_nan && std::memcmp(&x, &y, sizeof x) != 0);
  }
  return count;
}

}  // namespace softscope::test
