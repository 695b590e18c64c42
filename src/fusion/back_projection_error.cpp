#include "fusion/back_projection_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "fusion/sight.h"
#include "fusion/visibility.h"

namespace softscope {
namespace {

BackProjectionError summarise(std::vector<float> differences_mm) {
  BackProjectionError error;
  error.compared_px = static_cast<int>(differences_mm.size());
  if (differences_mm.empty()) return error;
  double sum = 0, absolute_sum = 0;
  for (float& difference : differences_mm) {
    sum += difference;
    difference = std::abs(difference);
    absolute_sum += difference;
  }
  const std::size_t rank = (differences_mm.size() - 1) * 95 / 100;
  std::nth_element(differences_mm.begin(), differences_mm.begin() + rank, differences_mm.end());
  error.mean_mm = absolute_sum / error.compared_px;
  error.bias_mm = sum / error.compared_px;
  error.p95_mm = differences_mm[rank];
  return error;
}

}  // namespace

BackProjectionError backProjectionError(const DrawnPoints& drawn, const Observation& observation,
                                        const Raster<PixelState>& states) {
  observation.validate();
  requireStates(states, observation);
  const PosedCamera& camera = drawn.camera();
  std::vector<std::vector<float>> rows(static_cast<std::size_t>(states.height_px));
  parallelRows(states.height_px, [&](int v) {
    std::vector<float>& differences_mm = rows[static_cast<std::size_t>(v)];
    for (int u = 0; u < states.width_px; ++u) {
      if (states.at(u, v) != PixelState::kSure) continue;
      const int index = drawn.pointAt(u, v);
      if (index < 0) continue;
      const Eigen::Vector3f left = camera.toLeft(drawn.model().positions_mm[index]);
      const Eigen::Vector3f lifted = camera.ray(u, v) * observation.depth.depth_mm.at(u, v);
      const float measured_mm = measuredDepth(left, lifted, observation.normals.at(u, v));
      if (std::isfinite(measured_mm)) differences_mm.push_back(left.z() - measured_mm);
    }
  });
  std::vector<float> all_mm;  // by rows, so that sums don't depend on threads
  all_mm.reserve(states.size());
  for (const std::vector<float>& row : rows) all_mm.insert(all_mm.end(), row.begin(), row.end());
  return summarise(std::move(all_mm));
}

BackProjectionError backProjectionError(const PointModel& model, const Observation& observation,
                                        const Raster<PixelState>& states) {
  observation.validate();
  const DrawnPoints drawn(model, posedCamera(observation.left, observation.world_from_left));
  return backProjectionError(drawn, observation, states);
}

}  // namespace softscope
