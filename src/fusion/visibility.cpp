#include "fusion/visibility.h"

#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/nearest_surface.h"
#include "fusion/sight_formulas.h"

namespace softscope {
namespace {

/// Marks points behind the nearest surface of the model as occluded: (F4).
void hideBehindModel(const PointModel& model, const PosedCamera& camera,
                     const NearestSurface& nearest, const VisibilityOptions& options,
                     Visibility* visibility) {
  const float margin_mm = static_cast<float>(options.kOcclusionMm);
  parallelRanges(static_cast<int>(model.size()), kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      PointSight& point = visibility->points[i];
      if (point.sight != Sight::kSeen && point.sight != Sight::kTurned) continue;
      const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
      const int u = point.pixel % camera.width_px, v = point.pixel / camera.width_px;
      if (!nearest.mayHide(u, v, left.z(), margin_mm)) continue;
      const float cosine = cosineToRay(left, camera.left_from_world * model.normals[i]);
      if (nearest.hides(u, v, left.z(), cosine, camera.fx_px, margin_mm))
        point.sight = Sight::kHidden;
    }
  });
}

}  // namespace

std::vector<std::int32_t> Visibility::seen() const {
  std::vector<std::int32_t> indices;
  indices.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].sight == Sight::kSeen) indices.push_back(static_cast<std::int32_t>(i));
  return indices;
}

void requireStates(const Raster<PixelState>& states, const Observation& observation) {
  if (!states.sameShape(observation.depth.depth_mm))
    throw OptionError(
        "fusion: the pixel states are not those of this observation; judge its "
        "pixels first");
}

void requireVisibility(const Visibility& visibility, const PointModel& model) {
  if (visibility.points.size() != model.size())
    throw OptionError("fusion: visibility is about " + std::to_string(visibility.points.size()) +
                      " points, but the model has " + std::to_string(model.size()) +
                      "; find the visible points again");
}

Visibility findVisible(const PointModel& model, const Observation& observation,
                       const Raster<PixelState>& states, const VisibilityOptions& options) {
  observation.validate();
  requireStates(states, observation);
  const PosedCamera camera = posedCamera(observation.left, observation.world_from_left);
  const SightLimits limits = sightLimits(options);
  const SightRasters rasters{observation.depth.depth_mm.values.data(),
                             observation.normals.values.data(), states.values.data()};
  NearestSurface nearest(camera.width_px, camera.height_px, options.kOcclusionCellPx);
  Visibility visibility;
  visibility.points.resize(model.size());
  parallelRanges(static_cast<int>(model.size()), kPointsPerTask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
      const PointSight sight =
          sightOf(left, camera.left_from_world * model.normals[i], camera, rasters, limits);
      visibility.points[i] = sight;
      // An obsolete point occludes nothing.
      if (sight.pixel >= 0 && sight.sight != Sight::kSeenThrough)
        nearest.add(sight.pixel % camera.width_px, sight.pixel / camera.width_px, left.z());
    }
  });
  hideBehindModel(model, camera, nearest, options, &visibility);
  return visibility;
}

}  // namespace softscope
