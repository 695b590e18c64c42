#include "fusion/back_projection_error.h"

#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/value_of_rank.h"
#include "fusion/sight.h"
#include "fusion/visibility.h"

namespace softscope {
namespace {

/// By rows of the image.
using Rows = std::vector<std::vector<float>>;

/// Sums are per row, independent of threads.
BackProjectionError summarise(const Rows& rows) {
  BackProjectionError error;
  std::size_t count = 0;
  for (const std::vector<float>& row : rows) count += row.size();
  error.compared_px = static_cast<int>(count);
  if (count == 0) return error;
  double sum = 0, absolute_sum = 0;
  const auto addUp = [&] {
    for (const std::vector<float>& row : rows)
      for (const float difference_mm : row) {
        sum += difference_mm;
        absolute_sum += std::abs(difference_mm);
      }
  };
  parallelInvoke(addUp, [&] { error.p95_mm = absoluteOfRank(rows, (count - 1) * 95 / 100); });
  error.mean_mm = absolute_sum / error.compared_px;
  error.bias_mm = sum / error.compared_px;
  return error;
}

}  // namespace

BackProjectionError backProjectionError(const DrawnPoints& drawn, const Observation& observation,
                                        const Raster<PixelState>& states) {
  observation.validate();
  requireStates(states, observation);
  const PosedCamera& camera = drawn.camera();
  Rows rows(static_cast<std::size_t>(states.height_px));
  parallelRows(states.height_px, [&](int v) {
    std::vector<float>& differences_mm = rows[static_cast<std::size_t>(v)];
    for (int u = 0; u < states.width_px; ++u) {
      if (states.at(u, v) != PixelState::kAccepted) continue;
      const int index = drawn.pointAt(u, v);
      if (index < 0) continue;
      const Eigen::Vector3f left = camera.toLeft(drawn.model().positions_mm[index]);
      const Eigen::Vector3f lifted = camera.ray(u, v) * observation.depth.depth_mm.at(u, v);
      const float measured_mm = measuredDepth(left, lifted, observation.normals.at(u, v));
      if (std::isfinite(measured_mm)) differences_mm.push_back(left.z() - measured_mm);
    }
  });
  return summarise(rows);
}

BackProjectionError backProjectionError(const PointModel& model, const Observation& observation,
                                        const Raster<PixelState>& states) {
  observation.validate();
  const DrawnPoints drawn(model, posedCamera(observation.left, observation.world_from_left));
  return backProjectionError(drawn, observation, states);
}

}  // namespace softscope
