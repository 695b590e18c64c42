#include "features/lift_matches.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softscope {
namespace {

constexpr float kLiftStepMm = 1;  // larger differences of four pixels are depth discontinuities

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

int nearestPixel(float x) { return static_cast<int>(std::lround(x)); }

float sigmaAt(const DepthMap& depth, const Eigen::Vector2f& place_px) {
  const int u = nearestPixel(place_px.x()), v = nearestPixel(place_px.y());
  return depth.sigma_mm.contains(u, v) ? depth.sigma_mm.at(u, v) : kNan;
}

}  // namespace

float depthAt(const Raster<float>& depth_mm, const Eigen::Vector2f& place_px, float max_step_mm) {
  const float fu = std::floor(place_px.x()), fv = std::floor(place_px.y());
  if (!(fu >= 0 && fv >= 0 && place_px.x() <= static_cast<float>(depth_mm.width_px - 1) &&
        place_px.y() <= static_cast<float>(depth_mm.height_px - 1)))
    return kNan;
  const int u = static_cast<int>(fu), v = static_cast<int>(fv);
  const int right = std::min(u + 1, depth_mm.width_px - 1);
  const int below = std::min(v + 1, depth_mm.height_px - 1);
  const float a = depth_mm.at(u, v), b = depth_mm.at(right, v);
  const float c = depth_mm.at(u, below), d = depth_mm.at(right, below);
  if (!(a > 0 && b > 0 && c > 0 && d > 0)) return kNan;
  if (!(std::max({a, b, c, d}) - std::min({a, b, c, d}) <= max_step_mm)) return kNan;
  const float x = place_px.x() - fu, y = place_px.y() - fv;
  return 1 / ((1 - y) * ((1 - x) / a + x / b) + y * ((1 - x) / c + x / d));
}

std::vector<LiftedMatch> liftMatches(const std::vector<PixelMatch>& matches, const ModelView& view,
                                     const DepthMap& live_depth, const PinholeCamera& live_camera) {
  const Eigen::Isometry3f world_from_left = view.world_from_left.cast<float>();
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
    out.source_world_mm =
        world_from_left * liftPixel(view.camera, match.model_px.x(), match.model_px.y(), model_mm);
    out.target_left_mm = liftPixel(live_camera, match.live_px.x(), match.live_px.y(), live_mm);
    out.across_mm = match.sigma_px * live_mm / static_cast<float>(live_camera.fx_px);
    out.along_mm = sigmaAt(live_depth, match.live_px);
    out.similarity = match.similarity;
    out.match = static_cast<int>(i);
    lifted.push_back(out);
  }
  return lifted;
}

}  // namespace softscope
