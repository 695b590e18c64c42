#include "pipeline/model/model_sigma.h"

#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "fusion/innovation.h"
#include "fusion/posed_camera.h"
#include "fusion/sight_formulas.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
PinholeCamera coarseCamera(const PinholeCamera& left) {
  constexpr int step = LevelledRelief::kStepPx;
  PinholeCamera camera = left;
  camera.width_px /= step;
  camera.height_px /= step;
  camera.fx_px /= step;
  camera.fy_px /= step;
  camera.cx_px = (left.cx_px + 0.5) / step - 0.5;
  camera.cy_px = (left.cy_px + 0.5) / step - 0.5;
  return camera;
}

/// The coarse pixel whose depth a point lies on; false where it is out of sight.
bool seenAt(const LastingErrors& errors, const PosedCamera& camera, const Eigen::Vector3f& left,
            int* u, int* v) {
  return camera.findPixel(left, u, v) &&
         std::abs(errors.depth_mm.at(*u, *v) - left.z()) < errors.same_surface_mm;
}

}  // namespace

void LastingErrors::observe(const LevelledRelief& relief, const Observation& frame,
                            const WarpGraph& graph, const FusionOptions& options) {
  reference_sigma_mm = frame.depth.sigma_mm.empty() ? 0 : options.points.reference_sigma_mm;
  camera = coarseCamera(frame.left);
  world_from_left = frame.world_from_left;
  same_surface_mm = options.visibility.max_distance_mm;
  depth_mm = relief.depth_mm;
  variance_mm2 = relief.variance_mm2;

  const PosedCamera posed = posedCamera(camera, frame.world_from_left);
  nodes_mm2.resize(graph.size(), kNaN);
  std::vector<std::size_t> hidden;
  double moved_mm2 = 0;  // of the nodes in sight since the last frame
  int moved = 0;
  for (std::size_t n = 0; n < graph.size(); ++n) {
    int u, v;
    if (!seenAt(*this, posed, posed.toLeft(graph.positions_mm[n].cast<float>()), &u, &v)) {
      hidden.push_back(n);
      continue;
    }
    nodes_mm2[n] = variance_mm2.at(u, v);
    if (n >= nodes_mm.size()) continue;
    moved_mm2 += (graph.positions_mm[n] - nodes_mm[n]).squaredNorm();
    ++moved;
  }
  constexpr int kDirections = 3;
  if (moved > 0)
    for (const std::size_t n : hidden)
      nodes_mm2[n] += static_cast<float>(moved_mm2 / (kDirections * moved));
  nodes_mm = graph.positions_mm;
}

std::vector<float> modelSigmas(const PointModel& model, const WarpGraph& graph,
                               const LastingErrors& errors) {
  if (!(errors.reference_sigma_mm > 0) || errors.depth_mm.empty()) return {};
  const PosedCamera camera = posedCamera(errors.camera, errors.world_from_left);
  const float unit_mm2 = static_cast<float>(errors.reference_sigma_mm * errors.reference_sigma_mm);
  const auto stencils = static_cast<std::int32_t>(graph.stencils.size());
  std::vector<float> sigmas_mm(model.size(), kNaN);
  parallelRanges(static_cast<int>(model.size()), kPointsPerTask, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const PointBinding& binding = model.bindings[i];
      const Eigen::Vector3f left = camera.toLeft(model.positions_mm[i]);
      float lasting_mm2 = kNaN;
      int u, v;
      if (seenAt(errors, camera, left, &u, &v)) {
        const float cosine = cosineToRay(left, camera.left_from_world * model.normals[i]);
        lasting_mm2 = cosine * cosine * errors.variance_mm2.at(u, v);
      } else if (isCarried(binding, stencils)) {
        const NodeStencil& stencil = graph.stencils[static_cast<std::size_t>(binding.stencil)];
        lasting_mm2 = 0;
        for (std::size_t k = 0; k < stencil.size(); ++k)
          if (static_cast<std::size_t>(stencil[k]) < errors.nodes_mm2.size())
            lasting_mm2 +=
                binding.weights[k] * errors.nodes_mm2[static_cast<std::size_t>(stencil[k])];
          else
            lasting_mm2 = kNaN;
      }
      sigmas_mm[i] = std::sqrt(unit_mm2 / model.weights[i] + lasting_mm2);
    }
  });
  return sigmas_mm;
}

}  // namespace softscope
