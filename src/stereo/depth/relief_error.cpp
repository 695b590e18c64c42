#include "stereo/depth/relief_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

// Integer sums: the same in any order of addition.
using Counts = Raster<std::int32_t>;

constexpr int kReach = 2 * RefinementOptions::radius_px;  // two windows in sequence
constexpr float kStepsAPx = 1024;                         // of disparity: 625 times 3355 px fit
constexpr float kStepsAPx2 = 65536;                       // of squared bends …
constexpr float kLargestBendPx2 = 50;                     // … 625 of which fit
constexpr int kBandRows = 48;

/// Over the `kReach` pixels to either side, per row.
Counts sumsAlongRows(const Counts& in) {
  Counts out(in.width_px, in.height_px);
  parallelRows(in.height_px, [&](int v) {
    const std::int32_t* from = in.row(v);
    std::int32_t* to = out.row(v);
    std::int32_t sum = 0;
    for (int u = 0; u < std::min(kReach, in.width_px); ++u) sum += from[u];
    for (int u = 0; u < in.width_px; ++u) {
      if (u + kReach < in.width_px) sum += from[u + kReach];
      if (u - kReach > 0) sum -= from[u - kReach - 1];
      to[u] = sum;
    }
  });
  return out;
}

/// Over the `kReach` pixels above and below.
Counts sumsAlongColumns(const Counts& in) {
  Counts out(in.width_px, in.height_px);
  parallelRanges(in.height_px, kBandRows, [&](int begin, int end) {
    std::vector<std::int32_t> sums(static_cast<std::size_t>(in.width_px), 0);
    const auto take = [&](int v, std::int32_t sign) {
      if (v < 0 || v >= in.height_px) return;
      for (int u = 0; u < in.width_px; ++u) sums[static_cast<std::size_t>(u)] += sign * in.at(u, v);
    };
    for (int v = begin - kReach; v < begin + kReach; ++v) take(v, 1);
    for (int v = begin; v < end; ++v) {
      take(v + kReach, 1);
      std::copy(sums.begin(), sums.end(), out.row(v));
      take(v - kReach, -1);
    }
  });
  return out;
}

Counts windowSums(const Counts& in) { return sumsAlongColumns(sumsAlongRows(in)); }

}  // namespace

Raster<float> reliefErrorPx(const Raster<float>& depth_mm, const RectifiedRig& rig) {
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  Counts measured(width, height, 0), steps(width, height, 0);
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      const float z = depth_mm.at(u, v);
      if (!(z > 0)) continue;
      measured.at(u, v) = 1;
      const float largest = static_cast<float>(StereoOptions::kLargestDisparityPx);
      steps.at(u, v) =
          static_cast<std::int32_t>(std::lround(kStepsAPx * std::min(scale / z, largest)));
    }
  });
  const Counts counts = windowSums(measured), means = windowSums(steps);
  Counts squares(width, height, 0);
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      if (measured.at(u, v) == 0) continue;
      const double bend_px =
          (steps.at(u, v) - static_cast<double>(means.at(u, v)) / counts.at(u, v)) / kStepsAPx;
      squares.at(u, v) = static_cast<std::int32_t>(
          std::lround(kStepsAPx2 * std::min<double>(bend_px * bend_px, kLargestBendPx2)));
    }
  });
  const Counts energies = windowSums(squares);
  Raster<float> error_px(width, height, std::numeric_limits<float>::quiet_NaN());
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u)
      if (measured.at(u, v) != 0)
        error_px.at(u, v) = std::sqrt(static_cast<float>(energies.at(u, v)) /
                                      (kStepsAPx2 * static_cast<float>(counts.at(u, v))));
  });
  return error_px;
}

void addReliefError(const RectifiedRig& rig, DisparityMap* disparity, DepthMap* depth) {
  if (depth->sigma_mm.empty()) return;
  const Raster<float> error_px = reliefErrorPx(depth->depth_mm, rig);
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  parallelRows(error_px.height_px, [&](int v) {
    for (int u = 0; u < error_px.width_px; ++u) {
      const float error = error_px.at(u, v), z = depth->depth_mm.at(u, v);
      if (std::isnan(error)) continue;
      float& sigma_mm = depth->sigma_mm.at(u, v);
      sigma_mm = std::hypot(sigma_mm, z * z / scale * error);
      if (disparity == nullptr || disparity->sigma_px.empty()) continue;
      float& sigma_px = disparity->sigma_px.at(u, v);
      sigma_px = std::hypot(sigma_px, error);
    }
  });
}

}  // namespace softscope
