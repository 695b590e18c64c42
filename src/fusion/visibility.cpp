#include "fusion/visibility.h"

#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/nearest_surface.h"

namespace softscope {
namespace {

Sight sightOfState(PixelState state) {
  return state == PixelState::kMasked ? Sight::kMasked : Sight::kUnknown;
}

/// What the measurement alone says about one point; adds it to the model's nearest surface.
PointSight sightOf(const Eigen::Vector3f& point_left, const Eigen::Vector3f& normal_left,
                   const PosedCamera& camera, const Observation& observation,
                   const Raster<PixelState>& states, const SightLimits& limits,
                   NearestSurface* nearest) {
  PointSight result;
  int u, v;
  if (!point_left.allFinite() || !camera.findPixel(point_left, &u, &v)) return result;
  const int pixel = v * camera.width_px + u;
  const PixelState state = states.values[pixel];
  if (state == PixelState::kSure) {
    const float depth_mm = observation.depth.depth_mm.values[pixel];
    result = compareWithPixel(point_left, normal_left, camera.ray(u, v) * depth_mm,
                              observation.normals.values[pixel], limits);
  } else {
    result.sight = sightOfState(state);
  }
  result.pixel = pixel;
  // A point that isn't there any more hides nothing.
  if (result.sight != Sight::kSeenThrough) nearest->add(u, v, point_left.z());
  return result;
}

/// Hides what lies behind the model's own nearest surface: (F4).
void hideBehindModel(const PointModel& model, const PosedCamera& camera,
                     const NearestSurface& nearest, const VisibilityOptions& options,
                     Visibility* visibility) {
  const float margin_mm = static_cast<float>(options.kOcclusionMm);
  parallelRanges(static_cast<int>(model.size()), kPointsATask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      PointSight& point = visibility->points[i];
      if (point.sight != Sight::kSeen && point.sight != Sight::kTurned) continue;
      const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
      const float cosine = -(camera.left_from_world * model.normals[i]).dot(left) / left.norm();
      if (nearest.hides(point.pixel % camera.width_px, point.pixel / camera.width_px, left.z(),
                        cosine, camera.fx_px, margin_mm))
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
  const SightLimits limits{static_cast<float>(options.max_distance_mm),
                           static_cast<float>(std::cos(options.kMaxAngleDeg * M_PI / 180))};
  NearestSurface nearest(camera.width_px, camera.height_px, options.kOcclusionCellPx);
  Visibility visibility;
  visibility.points.resize(model.size());
  parallelRanges(static_cast<int>(model.size()), kPointsATask, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      visibility.points[i] =
          sightOf(camera.toLeft(model.positions_mm[i]), camera.left_from_world * model.normals[i],
                  camera, observation, states, limits, &nearest);
  });
  hideBehindModel(model, camera, nearest, options, &visibility);
  return visibility;
}

}  // namespace softscope
