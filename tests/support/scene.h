// tests/support/scene.h: stereo pictures of surfaces that are known exactly.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

#include "core/image.h"
#include "core/stereo_rig.h"

namespace softscope::test {

/// A pair with the truth of its left picture.
struct Scene {
  GrayImage left, right;
  Raster<float> disparity_px;  // of the left picture; NaN where the ray misses
  Raster<float> depth_mm;
  RectifiedRig rig;
};

/// Distance in mm along a ray `direction` from `origin` (left camera's frame), or a negative value.
using Surface =
    std::function<double(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)>;

/// A plane through (0, 0, distance) with the given slopes dz/dx, dz/dy.
inline Surface plane(double distance_mm, double slope_x = 0, double slope_y = 0) {
  return [=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    return (distance_mm + slope_x * o.x() + slope_y * o.y() - o.z()) /
           (d.z() - slope_x * d.x() - slope_y * d.y());
  };
}

/// The near side of a sphere.
inline Surface sphere(const Eigen::Vector3d& centre_mm, double radius_mm) {
  return [=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    const Eigen::Vector3d to = o - centre_mm;
    const double a = d.squaredNorm(), b = to.dot(d), c = to.squaredNorm() - radius_mm * radius_mm;
    const double inside = b * b - a * c;
    return inside < 0 ? -1 : (-b - std::sqrt(inside)) / a;
  };
}

/// Whichever is met first.
inline Surface nearest(const Surface& one, const Surface& other) {
  return [=](const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    const double s = one(o, d), t = other(o, d);
    return s <= 0 ? t : (t <= 0 ? s : std::min(s, t));
  };
}

/// Smooth noise in space, 0 to 1, with structure of about
/// `size_mm`: both cameras see the same tissue, for any shape.
inline double solidTexture(const Eigen::Vector3d& point_mm, double size_mm) {
  const auto lattice = [](long x, long y, long z) {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
                      static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL ^
                      static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL;
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL;
    return static_cast<double>((h ^ (h >> 32)) & 0xFFFFFF) / 0xFFFFFF;
  };
  const Eigen::Vector3d p = point_mm / size_mm;
  const Eigen::Vector3d base(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
  const auto smooth = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double fx = smooth(p.x() - base.x()), fy = smooth(p.y() - base.y()),
               fz = smooth(p.z() - base.z());
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    sum += (x ? fx : 1 - fx) * (y ? fy : 1 - fy) * (z ? fz : 1 - fz) *
           lattice(static_cast<long>(base.x()) + x, static_cast<long>(base.y()) + y,
                   static_cast<long>(base.z()) + z);
  }
  return sum;
}

/// The rig of a 640 x 480 endoscope, scaled to other sizes.
inline RectifiedRig endoscope(int width_px = 320, int height_px = 240) {
  RectifiedRig rig;
  const double focal = 560.0 * width_px / 640;
  rig.left = {width_px, height_px, focal, focal, (width_px - 1) / 2.0, (height_px - 1) / 2.0};
  rig.baseline_mm = 5.0;
  return rig;
}

/// One camera's picture; `seen_mm` gets the depth where it isn't null.
inline GrayImage renderView(const RectifiedRig& rig, const Surface& surface, double offset_x_mm,
                            double noise_gray, unsigned seed, Raster<float>* seen_mm) {
  GrayImage image(rig.left.width_px, rig.left.height_px);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);  // a deviation of 0 is not allowed
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) {
      const Eigen::Vector3d direction =
          liftPixel(rig.left, static_cast<double>(u), static_cast<double>(v), 1.0);
      const Eigen::Vector3d origin(offset_x_mm, 0, 0);
      const double t = surface(origin, direction);
      const Eigen::Vector3d hit = origin + t * direction;
      const double texture = t <= 0 ? 0
                                    : 0.5 * solidTexture(hit, 1.3) + 0.3 * solidTexture(hit, 2.9) +
                                          0.2 * solidTexture(hit, 7.1);
      const double gray = (t <= 0 ? 0 : 40 + 170 * texture) + noise_gray * noise(random);
      image.at(u, v) = static_cast<std::uint8_t>(std::lround(std::clamp(gray, 0.0, 255.0)));
      if (seen_mm != nullptr && t > 0) seen_mm->at(u, v) = static_cast<float>(t);
    }
  return image;
}

/// The same in all three channels.
inline ColourImage colourOf(const GrayImage& gray) {
  ColourImage colour(gray.width_px, gray.height_px);
  for (std::size_t i = 0; i < gray.size(); ++i)
    colour.values[i] = {gray.values[i], gray.values[i], gray.values[i]};
  return colour;
}

inline Scene makeScene(const RectifiedRig& rig, const Surface& surface, double noise_gray = 0) {
  Scene scene;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  scene.rig = rig;
  scene.depth_mm = Raster<float>(rig.left.width_px, rig.left.height_px, nan);
  scene.disparity_px = scene.depth_mm;
  scene.left = renderView(rig, surface, 0, noise_gray, 1, &scene.depth_mm);
  scene.right = renderView(rig, surface, rig.baseline_mm, noise_gray, 2, nullptr);
  for (std::size_t i = 0; i < scene.depth_mm.size(); ++i)
    scene.disparity_px.values[i] =
        static_cast<float>(rig.disparityPx(scene.depth_mm.values[i]));  // NaN stays NaN
  return scene;
}

}  // namespace softscope::test
