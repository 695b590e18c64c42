// tests/deform/scenes.h: tissue whose true motion is known to the last digit.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/camera.h"
#include "core/depth_map.h"
#include "core/point_model.h"
#include "deform/energy/constraints.h"
#include "deform/graph/graph_builder.h"

namespace softscope::scenes {

/// Where a tissue point goes, world frame, mm.
using Motion = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// A hilly patch about 60 mm in front of the scope, as a height field over (x, y).
inline Eigen::Vector3d hillAt(double x_mm, double y_mm) {
  return {x_mm, y_mm, 60 + 3 * std::sin(x_mm / 9) * std::cos(y_mm / 11) + 0.02 * x_mm * y_mm / 10};
}

inline Eigen::Vector3d surfaceNormal(const std::function<Eigen::Vector3d(double, double)>& surface,
                                     double x_mm, double y_mm) {
  const double h = 1e-4;
  const Eigen::Vector3d along_x = surface(x_mm + h, y_mm) - surface(x_mm - h, y_mm);
  const Eigen::Vector3d along_y = surface(x_mm, y_mm + h) - surface(x_mm, y_mm - h);
  return along_y.cross(along_x).normalized();  // towards the scope, which views along +z
}

/// Points every `step_mm` (jittered by a fixed seed) over width x height, row by row.
inline PointModel makeHill(double width_mm, double height_mm, double step_mm) {
  PointModel model;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.3 * step_mm, 0.3 * step_mm);
  for (double y = -height_mm / 2; y <= height_mm / 2; y += step_mm)
    for (double x = -width_mm / 2; x <= width_mm / 2; x += step_mm) {
      const double px = x + jitter(random), py = y + jitter(random);
      model.add(hillAt(px, py).cast<float>(), surfaceNormal(hillAt, px, py).cast<float>(),
                {200, 120, 110}, 1);
    }
  return model;
}

inline WarpGraph bindGraph(PointModel* model, double spacing_mm = 4.0) {
  GraphOptions options;
  options.node_spacing_mm = spacing_mm;
  options.cell_mm = spacing_mm / 4;
  WarpGraph graph;
  growGraph(options, model, &graph);
  return graph;
}

/// The transforms of one rigid motion of all nodes.
inline void moveNodes(const Eigen::Isometry3d& motion, WarpGraph* graph) {
  for (std::size_t j = 0; j < graph->size(); ++j) {
    graph->transforms[j].linear = motion.linear();
    graph->transforms[j].translation_mm = motion * graph->positions_mm[j] - graph->positions_mm[j];
  }
}

inline PinholeCamera makeCamera(int width_px, int height_px, double f_px) {
  return {width_px, height_px, f_px, f_px, (width_px - 1) / 2.0, (height_px - 1) / 2.0};
}

/// What a scope at the origin measures of the moved hill: exact depth and normals.
struct View {
  PinholeCamera camera;
  DepthMap depth;
  NormalMap normals;
};

inline View renderHill(const PinholeCamera& camera, const Motion& motion, double width_mm,
                       double height_mm) {
  const auto surface = [&](double x, double y) { return motion(hillAt(x, y)); };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Vector3f no_normal = Eigen::Vector3f::Constant(nan);
  View view{camera, {}, NormalMap(camera.width_px, camera.height_px, no_normal)};
  view.depth.depth_mm = Raster<float>(camera.width_px, camera.height_px, nan);
  view.depth.sigma_mm = Raster<float>(camera.width_px, camera.height_px, nan);
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d ray = liftPixel<double>(camera, u, v, 1.0);
      Eigen::Vector2d at = 60 * ray.head<2>();
      Eigen::Vector3d hit = surface(at.x(), at.y());
      for (int i = 0; i < 12; ++i) {  // Newton: the hit is on the ray
        const double h = 1e-3;
        const Eigen::Vector2d miss = hit.head<2>() - hit.z() * ray.head<2>();
        Eigen::Matrix2d slope;
        for (int c = 0; c < 2; ++c) {
          const Eigen::Vector2d shifted = at + h * Eigen::Vector2d::Unit(c);
          const Eigen::Vector3d other = surface(shifted.x(), shifted.y());
          slope.col(c) = (other.head<2>() - other.z() * ray.head<2>() - miss) / h;
        }
        at -= slope.inverse() * miss;
        hit = surface(at.x(), at.y());
        if (miss.norm() < 1e-9) break;
      }
      if (std::abs(at.x()) > width_mm / 2 || std::abs(at.y()) > height_mm / 2) continue;
      view.depth.depth_mm.at(u, v) = static_cast<float>(hit.z());
      view.depth.sigma_mm.at(u, v) = 0.1f;
      view.normals.at(u, v) = surfaceNormal(surface, at.x(), at.y()).cast<float>();
    }
  return view;
}

/// Exact matches of every `stride`-th model point.
inline std::vector<KeyPointMatch> makeMatches(const PointModel& model, const Motion& motion,
                                              int stride) {
  std::vector<KeyPointMatch> matches;
  for (std::size_t i = 0; i < model.size(); i += static_cast<std::size_t>(stride)) {
    KeyPointMatch match;
    match.model_point = static_cast<std::int32_t>(i);
    match.source_mm = model.positions_mm[i];
    match.target_mm = motion(model.positions_mm[i].cast<double>()).cast<float>();
    matches.push_back(match);
  }
  return matches;
}

inline Eigen::Isometry3d rigidMotion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(Eigen::Vector3d(0.8, -0.5, 0.6));
  motion.translate(Eigen::Vector3d(0, 0, 60));
  motion.rotate(Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.3, 0.9, 0.2).normalized()));
  motion.translate(Eigen::Vector3d(0, 0, -60));
  return motion;
}

inline Motion shift(const Eigen::Vector3d& by_mm) {
  return [by_mm](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + by_mm; };
}

/// A breath and a push: 1.5 mm out over a third of the patch, 1 mm of stretch along the surface.
inline Eigen::Vector3d smoothBend(const Eigen::Vector3d& p) {
  const double push = std::exp(-(p.head<2>() - Eigen::Vector2d(4, -3)).squaredNorm() / (2 * 81));
  return p + Eigen::Vector3d(0.8 * std::sin(p.y() / 14), 0.6 * std::cos(p.x() / 15), -1.5 * push);
}

/// Mean distance between the warped model and the truth, mm.
inline double meanError(const PointModel& before, const PointModel& after, const Motion& motion) {
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    sum += (after.positions_mm[i].cast<double>() - motion(before.positions_mm[i].cast<double>()))
               .norm();
  return sum / static_cast<double>(before.size());
}

}  // namespace softscope::scenes
