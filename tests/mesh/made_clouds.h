// tests/mesh/made_clouds.h: points of surfaces with known answers.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <random>

#include "core/point_cloud.h"

namespace softscope {

/// Points of the plane z = `height_mm` that face `normal`, one per square of `spacing_mm`,
/// at a random position in it, if `keep(x, y)`; their colours encode their positions.
inline PointCloud planePoints(double width_mm, double spacing_mm, double height_mm = 0,
                              const Eigen::Vector3f& normal = {0, 0, 1},
                              const std::function<bool(double, double)>& keep = nullptr) {
  PointCloud cloud;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(0.1, 0.9);
  for (double y = 0; y < width_mm; y += spacing_mm)
    for (double x = 0; x < width_mm; x += spacing_mm) {
      const double px = x + spacing_mm * within(random), py = y + spacing_mm * within(random);
      if (keep && !keep(px, py)) continue;
      cloud.points_mm.emplace_back(float(px), float(py), float(height_mm));
      cloud.normals.push_back(normal);
      cloud.colours.push_back({std::uint8_t(10 * px), std::uint8_t(10 * py), 99});
    }
  return cloud;
}

/// Points of the cap of a sphere around the origin above `least_z_mm`, evenly distributed.
inline PointCloud capPoints(double radius_mm, double least_z_mm, double spacing_mm) {
  PointCloud cloud;
  const double golden = 3.14159265358979 * (3 - std::sqrt(5.0));
  // Each point has an area of spacing²; a zone of a sphere has 2 pi radius times its height.
  const double step_mm = spacing_mm * spacing_mm / (2 * 3.14159265358979 * radius_mm);
  int i = 0;
  for (double z = radius_mm - step_mm / 2; z > least_z_mm; z -= step_mm, ++i) {
    const double ring = std::sqrt(radius_mm * radius_mm - z * z);
    const Eigen::Vector3d p(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
    cloud.points_mm.push_back(p.cast<float>());
    cloud.normals.push_back((p / radius_mm).cast<float>());
  }
  return cloud;
}

inline void append(PointCloud& all, const PointCloud& more) {
  all.points_mm.insert(all.points_mm.end(), more.points_mm.begin(), more.points_mm.end());
  all.normals.insert(all.normals.end(), more.normals.begin(), more.normals.end());
  all.colours.insert(all.colours.end(), more.colours.begin(), more.colours.end());
}

}  // namespace softscope
