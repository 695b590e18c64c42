#include "pipeline/frame/relocaliser.h"

#include <algorithm>
#include <limits>

#include "core/median.h"
#include "features/match_pyramid.h"
#include "pipeline/frame/model_matches.h"

namespace softscope {
namespace {

constexpr double kRadiusPx = 8;    // of a patch, in pixels of the small image at typical depth
constexpr int kSpacingPx = 3;      // of patches
constexpr double kMaxRatio = 0.9;  // best distance over the best one elsewhere

/// The camera of an image of half the size; pixel centres have whole coordinates.
PinholeCamera halved(PinholeCamera camera) {
  camera.fx_px /= 2;
  camera.fy_px /= 2;
  camera.cx_px = (camera.cx_px + 0.5) / 2 - 0.5;
  camera.cy_px = (camera.cy_px + 0.5) / 2 - 0.5;
  camera.width_px /= 2;
  camera.height_px /= 2;
  return camera;
}

/// Means of 2 x 2 pixels; NaN if one has no depth or they are on two surfaces.
Raster<float> halved(const Raster<float>& depth_mm) {
  constexpr float kLargestStep = 0.05F;  // of the depth
  Raster<float> coarse(depth_mm.width_px / 2, depth_mm.height_px / 2);
  for (int v = 0; v < coarse.height_px; ++v)
    for (int u = 0; u < coarse.width_px; ++u) {
      const float *above = depth_mm.row(2 * v) + 2 * u, *below = depth_mm.row(2 * v + 1) + 2 * u;
      const float mean = 0.25F * (above[0] + above[1] + below[0] + below[1]);
      const float step = std::max({above[0], above[1], below[0], below[1]}) -
                         std::min({above[0], above[1], below[0], below[1]});
      coarse.at(u, v) =
          step <= kLargestStep * mean ? mean : std::numeric_limits<float>::quiet_NaN();
    }
  return coarse;
}

DepthImage smallLive(const MatchPicture& live, const MeasuredFrame& frame,
                     const PinholeCamera& camera) {
  MatchPicture picture{live.gray, live.ignore};
  DepthImage image{camera, {}, {}, frame.depth.depth_mm};
  while (std::min(image.camera.width_px, image.camera.height_px) / 2 >= kLeastMatchSidePx) {
    picture = halved(picture);
    image.depth_mm = halved(image.depth_mm);
    image.camera = halved(image.camera);
  }
  image.gray = std::move(picture.gray);
  image.ignore = std::move(picture.ignore);
  return image;
}

double typicalDepthMm(const Raster<float>& depth_mm) {
  std::vector<float> known;
  for (const float value : depth_mm.values)
    if (value > 0) known.push_back(value);
  return medianOf(std::move(known));
}

/// Model points as patches of the view, and the live patches that match them.
PointPairs pairsOf(const std::vector<SurfacePatch>& live, const std::vector<SurfacePatch>& model,
                   const Eigen::Isometry3f& world_from_view, double elsewhere_mm) {
  PointPairs pairs;
  for (const auto& [i, k] : matchPatches(live, model, kMaxRatio, elsewhere_mm)) {
    pairs.sources_mm.push_back(live[static_cast<std::size_t>(i)].centre_mm);
    pairs.targets_mm.push_back(world_from_view * model[static_cast<std::size_t>(k)].centre_mm);
  }
  return pairs;
}

}  // namespace

RigidPose relocalise(const PointModel& model, const std::vector<Eigen::Isometry3d>& viewpoints,
                     const MatchPicture& live, const MeasuredFrame& frame,
                     const PinholeCamera& camera, const ModelViewOptions& view_options,
                     const RansacOptions& ransac) {
  const DepthImage image = smallLive(live, frame, camera);
  const double radius_mm = kRadiusPx * typicalDepthMm(image.depth_mm) / image.camera.fx_px;
  const std::vector<SurfacePatch> patches = surfacePatches(image, radius_mm, kSpacingPx);
  RigidPose best;
  if (patches.empty()) {
    best.failure = "no part of the image has texture and depth";
    return best;
  }
  for (const Eigen::Isometry3d& viewpoint : viewpoints) {
    const ModelView view = renderModelView(model, image.camera, viewpoint, view_options);
    const MatchPicture picture = modelPicture(view);
    const std::vector<SurfacePatch> seen = surfacePatches(
        {view.camera, picture.gray, picture.ignore, view.depth_mm}, radius_mm, kSpacingPx);
    const RigidPose pose =
        estimateRigidPose(pairsOf(patches, seen, viewpoint.cast<float>(), radius_mm), ransac);
    if (pose.found && pose.inliers > best.inliers) best = pose;
    if (best.failure.empty() && !best.found) best.failure = pose.failure;
  }
  return best;
}

}  // namespace softscope
