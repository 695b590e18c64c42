#include "pipeline/tracks/track_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "fusion/fusion_options.h"
#include "stereo/depth/relief_error.h"

namespace softscope {
namespace {

constexpr double kFarthestPx = 1e6;    // limit of pixel coordinates
constexpr double kFloatingLimits = 3;  // before the surface, in units of the limit behind it

/// Pixel of a point; far outside of every image if there is none.
Eigen::Vector2d pixelOf(const PinholeCamera& left, const Eigen::Vector3d& point_left) {
  const Eigen::Vector2d nowhere(-kFarthestPx, -kFarthestPx);
  if (!point_left.allFinite() || !(point_left.z() > 0)) return nowhere;
  const Eigen::Vector2d pixel = projectPoint(left, point_left).array().round();
  return pixel.allFinite() && pixel.cwiseAbs().maxCoeff() < kFarthestPx ? pixel : nowhere;
}

/// Variances of the depth at a pixel that uses the surface of a neighbour.
struct DepthVariance {
  double noise_mm2 = 0, relief_mm2 = 0;
};

DepthVariance depthVariance(const DepthMap& depth, const Raster<float>& relief_px,
                            const Eigen::Vector2d& pixel, const NearestDepth& surface,
                            const RectifiedRig& rig) {
  constexpr double kUnknownMm2 = std::numeric_limits<double>::quiet_NaN();
  if (depth.sigma_mm.empty()) return {kUnknownMm2, kUnknownMm2};
  const Eigen::Vector2d at = (pixel + surface.away_px).array().round();
  const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
  const double sigma_mm = depth.sigma_mm.at(u, v), slack_mm = surface.slackMm(rig.left.fx_px);
  const double relief_mm = sigmaWithRelief(rig, 0, depth.depth_mm.at(u, v), relief_px.at(u, v));
  return {sigma_mm * sigma_mm + slack_mm * slack_mm, relief_mm * relief_mm};
}

}  // namespace

NearestDepth TrackSight::surfaceAt(const Eigen::Vector3d& point_left, int gap_px) const {
  const Raster<float>& depth_mm = frame_.measured.depth.depth_mm;
  const Eigen::Vector2d pixel = pixelOf(rig_.left, point_left);
  const NearestDepth here = nearestDepth(depth_mm, pixel, 0);
  return here.found() ? here : nearestDepth(depth_mm, pixel, gap_px);
}

bool TrackSight::shows(const Eigen::Vector3d& point_left, const NearestDepth& surface) const {
  const Eigen::Vector2d pixel = pixelOf(rig_.left, point_left);
  const int u = static_cast<int>(pixel.x()), v = static_cast<int>(pixel.y());
  if (!frame_.not_tissue.contains(u, v) || frame_.not_tissue.at(u, v) != 0) return false;
  if (!surface.found()) return true;
  const double behind_mm = point_left.z() - surface.depth_mm;
  const double slack_mm = surface.slackMm(rig_.left.fx_px);
  const double limit_mm = VisibilityOptions::kOcclusionMm * frame_.summary.limit_scale;
  // Errors of tracks and of depth stay below the second limit; points beyond it are lost.
  return behind_mm <= limit_mm + slack_mm && -behind_mm <= kFloatingLimits * limit_mm + slack_mm;
}

std::vector<TrackedPosition> TrackSight::positions(const MaterialPoints& tracked,
                                                   const Eigen::Isometry3d& world_from_left,
                                                   const Raster<float>& relief_px) const {
  constexpr int kTracksPerTask = 8;
  const DepthMap& depth = frame_.measured.depth;
  const bool drift_known = std::isfinite(tracked.drift_mm2);
  const auto positionOf = [&](const MaterialPoints::Point& point) {
    const Eigen::Vector3d centre = world_from_left.inverse() * point.position_mm;
    const NearestDepth surface = surfaceAt(centre, gapPx(depth.depth_mm.width_px));
    TrackedPosition position{point.id, point.position_mm, false};
    if (!surface.found() || !shows(centre, surface)) return position;
    // Hidden before, and not found since: it may lie elsewhere.
    if (drift_known && !std::isfinite(point.variance_mm2)) return position;
    const DepthVariance of_depth =
        depthVariance(depth, relief_px, pixelOf(rig_.left, centre), surface, rig_);
    const double sigma_mm =
        std::sqrt(2 * point.variance_mm2 + of_depth.noise_mm2 + of_depth.relief_mm2);
    // As for a depth: worse ones update nothing.
    position.visible = !(sigma_mm > frame_.fusion.pixels.max_sigma_mm);
    if (position.visible) position.sigma_mm = sigma_mm;
    position.measured = position.visible && hasOwnDepth(depth.depth_mm, pixelOf(rig_.left, centre));
    return position;
  };
  std::vector<TrackedPosition> positions(tracked.points.size());
  parallelRanges(static_cast<int>(positions.size()), kTracksPerTask, [&](int begin, int end) {
    std::transform(tracked.points.begin() + begin, tracked.points.begin() + end,
                   positions.begin() + begin, positionOf);
  });
  return positions;
}

}  // namespace softscope
