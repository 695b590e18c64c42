#include "pipeline/model/model_sigma.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "fusion/innovation.h"
#include "fusion/posed_camera.h"
#include "fusion/sight_formulas.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kWindowPx = 2 * RefinementOptions::radius_px + 1;      // of stereo
constexpr int kTwoWindowsPx = 4 * RefinementOptions::radius_px + 1;  // one after the other
constexpr int kReach = (kTwoWindowsPx / 2) / LastingErrors::kStepPx;
/// Of what the mean over two windows takes from a bend that is alike everywhere, one window does.
constexpr double kOneOfTwo =
    static_cast<double>(kWindowPx * kWindowPx) / (kTwoWindowsPx * kTwoWindowsPx);

PinholeCamera coarseCamera(const PinholeCamera& left) {
  constexpr int step = LastingErrors::kStepPx;
  PinholeCamera camera = left;
  camera.width_px /= step;
  camera.height_px /= step;
  camera.fx_px /= step;
  camera.fy_px /= step;
  camera.cx_px = (left.cx_px + 0.5) / step - 0.5;
  camera.cy_px = (left.cy_px + 0.5) / step - 0.5;
  return camera;
}

/// One pixel of each square.
Raster<float> thinned(const Raster<float>& fine) {
  constexpr int step = LastingErrors::kStepPx;
  Raster<float> coarse(fine.width_px / step, fine.height_px / step);
  for (int v = 0; v < coarse.height_px; ++v)
    for (int u = 0; u < coarse.width_px; ++u)
      coarse.at(u, v) = fine.at(step * u + step / 2, step * v + step / 2);
  return coarse;
}

/// Sums over the squares within kReach of each pixel: along rows, then along columns.
template <class Number>
Raster<Number> windowSums(const Raster<Number>& in) {
  const int width = in.width_px, height = in.height_px;
  Raster<Number> across(width, height, 0), sums(width, height, 0);
  parallelRows(height, [&](int v) {
    const Number* from = in.row(v);
    Number* to = across.row(v);
    for (int x = -kReach; x <= kReach; ++x)
      for (int u = std::max(0, -x); u < std::min(width, width - x); ++u) to[u] += from[u + x];
  });
  parallelRows(height, [&](int v) {
    Number* to = sums.row(v);
    for (int y = std::max(0, v - kReach); y <= std::min(height - 1, v + kReach); ++y)
      for (int u = 0; u < width; ++u) to[u] += across.row(y)[u];
  });
  return sums;
}

/// Number of known values within kReach.
Raster<int> windowCounts(const Raster<float>& in) {
  Raster<int> known(in.width_px, in.height_px);
  for (std::size_t i = 0; i < in.size(); ++i) known.values[i] = !std::isnan(in.values[i]);
  return windowSums(known);
}

/// Mean over the `counts` known values within kReach, where the value itself is known; else NaN.
Raster<float> windowMeans(const Raster<float>& in, const Raster<int>& counts) {
  Raster<double> known(in.width_px, in.height_px);
  for (std::size_t i = 0; i < in.size(); ++i)
    known.values[i] = std::isnan(in.values[i]) ? 0.0f : in.values[i];
  const Raster<double> sums = windowSums(known);
  Raster<float> means(in.width_px, in.height_px);
  for (std::size_t i = 0; i < in.size(); ++i)
    means.values[i] =
        std::isnan(in.values[i]) ? kNaN : static_cast<float>(sums.values[i] / counts.values[i]);
  return means;
}

/// Variance of the disparity by relief, px^2: docs/fusion.md (F30).
Raster<float> reliefVariance(const Raster<float>& disparity_px) {
  const Raster<int> counts = windowCounts(disparity_px);
  Raster<float> bend = windowMeans(disparity_px, counts);
  for (std::size_t i = 0; i < bend.size(); ++i)
    bend.values[i] = disparity_px.values[i] - bend.values[i];
  const Raster<float> mean = windowMeans(bend, counts);
  for (float& value : bend.values) value *= value;
  Raster<float> variance = windowMeans(bend, counts);
  for (std::size_t i = 0; i < variance.size(); ++i) {
    if (std::isnan(variance.values[i])) continue;
    const double mean_sq = static_cast<double>(mean.values[i]) * mean.values[i];
    variance.values[i] = static_cast<float>(std::max(0.0, variance.values[i] - mean_sq) +
                                            kOneOfTwo * kOneOfTwo * mean_sq);
  }
  return variance;
}

/// The coarse pixel whose depth a point lies on; false where it is out of sight.
bool seenAt(const LastingErrors& errors, const PosedCamera& camera, const Eigen::Vector3f& left,
            int* u, int* v) {
  return camera.findPixel(left, u, v) &&
         std::abs(errors.depth_mm.at(*u, *v) - left.z()) < errors.same_surface_mm;
}

}  // namespace

void LastingErrors::observe(const DepthMap& depth, const RectifiedRig& rig,
                            const Eigen::Isometry3d& pose, const WarpGraph& graph,
                            const FusionOptions& options) {
  reference_sigma_mm = depth.sigma_mm.empty() ? 0 : options.points.reference_sigma_mm;
  camera = coarseCamera(rig.left);
  world_from_left = pose;
  same_surface_mm = options.visibility.max_distance_mm;
  depth_mm = thinned(depth.depth_mm);
  const double scale = rig.left.fx_px * rig.baseline_mm;
  Raster<float> disparity_px = depth_mm;
  for (float& value : disparity_px.values) value = static_cast<float>(scale / value);
  variance_mm2 = reliefVariance(disparity_px);
  for (std::size_t i = 0; i < variance_mm2.size(); ++i) {
    const double mm_per_px = depth_mm.values[i] * (depth_mm.values[i] / scale);
    variance_mm2.values[i] *= static_cast<float>(mm_per_px * mm_per_px);
  }

  const PosedCamera posed = posedCamera(camera, pose);
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
