#include "features/lift_matches.h"

#include "core/not_measured.h"
#include "features/lift_formulas.h"

namespace softscope {
namespace {

float sigmaAt(const DepthMap& depth, const Eigen::Vector2f& place_px) {
  const int u = nearestPixel(place_px.x()), v = nearestPixel(place_px.y());
  return depth.sigma_mm.contains(u, v) ? depth.sigma_mm.at(u, v) : kNotMeasured<float>;
}

}  // namespace

float depthAt(const Raster<float>& depth_mm, const Eigen::Vector2f& place_px, float max_step_mm) {
  const float found =
      depthBetween([&](int u, int v) { return depth_mm.at(u, v); }, depth_mm.width_px,
                   depth_mm.height_px, place_px.x(), place_px.y(), max_step_mm);
  return found > 0 ? found : kNotMeasured<float>;
}

RigidRows rigidRows(const Eigen::Isometry3d& motion) {
  RigidRows rows{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rows.turn[i][j] = static_cast<float>(motion.matrix()(i, j));
    rows.shift[i] = static_cast<float>(motion.matrix()(i, 3));
  }
  return rows;
}

std::vector<LiftedMatch> liftMatches(const std::vector<PixelMatch>& matches, const ModelView& view,
                                     const DepthMap& live_depth, const PinholeCamera& live_camera) {
  const RigidRows world_from_left = rigidRows(view.world_from_left);
  std::vector<LiftedMatch> lifted;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const PixelMatch& match = matches[i];
    const float model_mm = depthAt(view.depth_mm, match.model_px, kLiftStepMm);
    const float live_mm = depthAt(live_depth.depth_mm, match.live_px, kLiftStepMm);
    if (!(model_mm > 0 && live_mm > 0)) continue;
    const std::int32_t point =
        view.point_index.at(nearestPixel(match.model_px.x()), nearestPixel(match.model_px.y()));
    if (point < 0) continue;
    LiftedMatch out;
    out.model_point = point;
    const Eigen::Vector3f seen =
        liftPixel(view.camera, match.model_px.x(), match.model_px.y(), model_mm);
    float world[3];
    world_from_left.move({seen.x(), seen.y(), seen.z()}, world);
    out.source_world_mm = {world[0], world[1], world[2]};
    out.target_left_mm = liftPixel(live_camera, match.live_px.x(), match.live_px.y(), live_mm);
    out.across_mm = acrossMm(match.sigma_px, live_mm, live_camera);
    out.along_mm = sigmaAt(live_depth, match.live_px);
    out.similarity = match.similarity;
    out.match = static_cast<int>(i);
    lifted.push_back(out);
  }
  return lifted;
}

}  // namespace softscope
