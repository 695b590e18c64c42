// tests/cuda/locate_cases.h: a model, found again in a later image.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "features/lift_matches.h"
#include "features/matcher.h"
#include "features/model_view.h"
#include "support/scene.h"

namespace softscope::test {

/// A textured plane as a model, and what a camera sees of it that has moved on.
struct LocateScene {
  PinholeCamera camera = endoscope(240, 192).left;
  ModelViewOptions view_options;
  PointModel model;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  MatchPicture live;
  DepthMap depth;
};

inline double planeGray(double x_mm, double y_mm) {
  const Eigen::Vector3d place(x_mm, y_mm, 3.1);
  return 70 + 60 * solidTexture(place, 1.2) + 60 * solidTexture(place, 3.3);
}

inline LocateScene locateScene() {
  LocateScene scene;
  const double z_mm = 50, moved_mm = 0.8, half_mm = 0.55 * 240 * z_mm / scene.camera.fx_px;
  scene.view_options.point_spacing_mm = z_mm / scene.camera.fx_px;
  const double step_mm = scene.view_options.point_spacing_mm;
  for (double y = -half_mm; y < half_mm; y += step_mm)
    for (double x = -half_mm; x < half_mm; x += step_mm) {
      const auto gray = static_cast<std::uint8_t>(planeGray(x, y));
      scene.model.add(Eigen::Vector3d(x, y, z_mm).cast<float>(), {0, 0, -1}, {gray, gray, gray}, 1);
    }
  scene.world_from_left = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ());
  scene.world_from_left.translation() = Eigen::Vector3d(0.3, -0.2, 0.5);
  scene.live.gray = GrayImage(240, 192);
  scene.live.ignore = Mask(240, 192, 0);
  scene.depth = {Raster<float>(240, 192, static_cast<float>(z_mm)), Raster<float>(240, 192, 0.1f)};
  for (int v = 0; v < 192; ++v)
    for (int u = 0; u < 240; ++u) {
      const Eigen::Vector3d at = liftPixel<double>(scene.camera, u, v, z_mm);
      scene.live.gray.at(u, v) =
          static_cast<std::uint8_t>(1.1 * planeGray(at.x() + moved_mm, at.y()) + 5);
      if (u > 100 && u < 120) scene.live.ignore.at(u, v) = 1;
      if (v > 90 && v < 100) scene.depth.depth_mm.at(u, v) = std::nanf("");
      scene.depth.sigma_mm.at(u, v) += 0.001f * static_cast<float>(u);
    }
  return scene;
}

/// What the CPU finds; the model looked like `seen_gray` from there, or, empty, as it is drawn.
inline std::vector<LiftedMatch> cpuLifted(const LocateScene& scene, const GrayImage& seen_gray) {
  const ModelView view =
      renderModelView(scene.model, scene.camera, scene.world_from_left, scene.view_options);
  MatchPicture picture{toGray(view.colour), Mask(240, 192, 0), view.anchor};
  for (std::size_t i = 0; i < picture.ignore.size(); ++i)
    picture.ignore.values[i] = view.point_index.values[i] < 0;
  if (!seen_gray.empty()) picture = {seen_gray, picture.ignore};
  return liftMatches(makeFeatureMatcher(MatcherOptions())->match(picture, scene.live), view,
                     scene.depth, scene.camera);
}

/// How many differ in a bit, NaN alike; -1: another number of them.
inline int differingLifted(const std::vector<LiftedMatch>& a, const std::vector<LiftedMatch>& b) {
  if (a.size() != b.size()) return -1;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool both_nan = std::isnan(a[i].along_mm) && std::isnan(b[i].along_mm);
    count += a[i].model_point != b[i].model_point || a[i].match != b[i].match ||
             a[i].source_world_mm != b[i].source_world_mm ||
             a[i].target_left_mm != b[i].target_left_mm || a[i].across_mm != b[i].across_mm ||
             (!both_nan && a[i].along_mm != b[i].along_mm) || a[i].similarity != b[i].similarity;
  }
  return count;
}

}  // namespace softscope::test
