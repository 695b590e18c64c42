// tests/fusion/made_shots.h: what a scope would measure of a known surface, with known errors.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "core/point_model.h"
#include "fusion/model_update.h"
#include "support/scene.h"

namespace softscope::test {

constexpr float kNoDepth = std::numeric_limits<float>::quiet_NaN();

/// An observation that owns its rasters, with its truth.
struct Shot {
  DepthMap depth;
  NormalMap normals;
  ColourImage colour;
  Mask mask;
  Raster<float> truth_mm;
  PinholeCamera left;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();

  Observation observation() const { return {depth, normals, colour, mask, left, world_from_left}; }
};

/// The middle of a 640 x 480 endoscope's picture: a pixel is 0.1 mm at 55 mm.
inline PinholeCamera smallCamera(int width_px = 96, int height_px = 72, double focal_px = 560) {
  return {width_px, height_px, focal_px, focal_px, (width_px - 1) / 2.0, (height_px - 1) / 2.0};
}

inline Eigen::Isometry3d shifted(double x, double y, double z) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

/// The pose's rotation of a direction. Written out: the product of Eigen, which clang does not
/// inline under sanitizers, was half of the time of these tests.
inline Eigen::Vector3d rotated(const Eigen::Isometry3d& pose, const Eigen::Vector3d& direction) {
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const auto row = [&](int i) { return pose(i, 0) * x + pose(i, 1) * y + pose(i, 2) * z; };
  return {row(0), row(1), row(2)};
}

/// Depth, mm, at which (u, v) sees the surface (world frame); NaN where it misses.
inline double trueDepth(const Surface& surface, const PinholeCamera& left,
                        const Eigen::Isometry3d& world_from_left, double u, double v) {
  const Eigen::Vector3d ray = liftPixel(left, u, v, 1.0);
  const double t = surface(world_from_left.translation(), rotated(world_from_left, ray));
  return t > 0 ? t : std::numeric_limits<double>::quiet_NaN();
}

inline Eigen::Vector3f trueNormal(const Surface& surface, const PinholeCamera& left,
                                  const Eigen::Isometry3d& pose, double u, double v) {
  const double h = 0.01;
  const auto point = [&](double x, double y) {
    return liftPixel<double>(left, x, y, trueDepth(surface, left, pose, x, y));
  };
  const Eigen::Vector3d du = point(u + h, v) - point(u - h, v);
  const Eigen::Vector3d dv = point(u, v + h) - point(u, v - h);
  return dv.cross(du).normalized().cast<float>();  // towards the camera
}

/// Without errors; sigma_mm = sigma_per_mm2 z². All pixels have one colour.
inline Shot takeShot(const Surface& surface, const PinholeCamera& left,
                     const Eigen::Isometry3d& pose = Eigen::Isometry3d::Identity(),
                     double sigma_per_mm2 = 3.3e-5, Rgb8 colour = {150, 90, 80}) {
  Shot shot;
  shot.left = left;
  shot.world_from_left = pose;
  const int width = left.width_px, height = left.height_px;
  shot.truth_mm = Raster<float>(width, height);
  shot.depth.sigma_mm = Raster<float>(width, height);
  shot.normals = NormalMap(width, height, Eigen::Vector3f::Zero());
  shot.colour = ColourImage(width, height, colour);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double z = trueDepth(surface, left, pose, u, v);
      shot.truth_mm.at(u, v) = static_cast<float>(z);
      shot.depth.sigma_mm.at(u, v) = static_cast<float>(sigma_per_mm2 * z * z);
      shot.normals.at(u, v) = trueNormal(surface, left, pose, u, v);
    }
  shot.depth.depth_mm = shot.truth_mm;
  return shot;
}

/// Independent Gaussian errors of the size that the shot claims.
inline void addNoise(unsigned seed, Shot* shot) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise;
  for (std::size_t i = 0; i < shot->depth.depth_mm.size(); ++i)
    shot->depth.depth_mm.values[i] += noise(random) * shot->depth.sigma_mm.values[i];
}

/// Square patches of wrong depth, 3 to 8 mm off either way, over about `share` of the picture.
inline void addWrongPatches(double share, int side_px, unsigned seed, Shot* shot) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  const int width = shot->left.width_px, height = shot->left.height_px;
  const int patches = static_cast<int>(std::ceil(share * width * height / (side_px * side_px)));
  for (int k = 0; k < patches; ++k) {
    const int u0 = static_cast<int>(uniform(random) * (width - side_px));
    const int v0 = static_cast<int>(uniform(random) * (height - side_px));
    const double off_mm = (uniform(random) < 0.5 ? -1 : 1) * (3 + 5 * uniform(random));
    for (int v = v0; v < v0 + side_px; ++v)
      for (int u = u0; u < u0 + side_px; ++u)
        shot->depth.depth_mm.at(u, v) = shot->truth_mm.at(u, v) + static_cast<float>(off_mm);
  }
}

/// One update.
inline ModelUpdateSummary update(const Shot& shot, const WarpGraph& graph,
                                 const FusionOptions& options, InsertionMemory* memory,
                                 PointModel* model) {
  const Observation observation = shot.observation();
  return updateModel(observation, classifyPixels(observation, options.pixels), graph, options,
                     memory, model);
}

/// On a graph without nodes.
inline ModelUpdateSummary update(const Shot& shot, const FusionOptions& options,
                                 InsertionMemory* memory, PointModel* model) {
  return update(shot, WarpGraph{}, options, memory, model);
}

/// Distance of each point behind the surface, mm along the
/// axis of the camera of this shot; NaN if its ray misses.
inline std::vector<double> depthErrors(const PointModel& model, const Surface& surface,
                                       const Shot& shot) {
  std::vector<double> errors;
  for (const Eigen::Vector3f& p : model.positions_mm) {
    const Eigen::Vector3d left = shot.world_from_left.inverse() * p.cast<double>();
    const Eigen::Vector2d pixel = projectPoint<double>(shot.left, left);
    errors.push_back(left.z() -
                     trueDepth(surface, shot.left, shot.world_from_left, pixel.x(), pixel.y()));
  }
  return errors;
}

inline double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

inline double rmsOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

inline double largestOf(const std::vector<double>& values) {
  double largest = 0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  return largest;
}

/// Byte for byte, NaN included.
template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool sameModel(const PointModel& a, const PointModel& b) {
  return sameBytes(a.positions_mm, b.positions_mm) && sameBytes(a.normals, b.normals) &&
         a.colours == b.colours && sameBytes(a.weights, b.weights);
}

}  // namespace softscope::test
