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

constexpr int kSmoothedReach = 2 * RefinementOptions::radius_px;  // two windows in sequence
constexpr float kStepsPerPx = 1024;    // of disparity: 625 times 3355 px fit
constexpr float kStepsAPx2 = 65536;    // of squared bends …
constexpr float kLargestBendPx2 = 50;  // … 625 of which fit
constexpr int kReliefBandRows = 48;

/// The nearest whole number of one that is not negative, as std::lround(), which is a call.
template <class Real>
std::int32_t rounded(Real x) {
  const std::int32_t whole = static_cast<std::int32_t>(x);
  return whole + (x - static_cast<Real>(whole) >= Real(0.5) ? 1 : 0);
}

/// Over the `kSmoothedReach` pixels to either side, per row.
Counts sumsAlongRows(const Counts& in) {
  Counts out(in.width_px, in.height_px);
  const int width = in.width_px;
  parallelRows(in.height_px, [&](int v) {
    const std::int32_t* from = in.row(v);
    std::int32_t* to = out.row(v);
    std::int32_t sum = 0;
    for (int u = 0; u < std::min(kSmoothedReach, width); ++u) sum += from[u];
    int u = 0;
    for (; u < width && u <= kSmoothedReach; ++u)
      to[u] = sum += u + kSmoothedReach < width ? from[u + kSmoothedReach] : 0;
    for (; u < width - kSmoothedReach; ++u)
      to[u] = sum += from[u + kSmoothedReach] - from[u - kSmoothedReach - 1];
    for (; u < width; ++u) to[u] = sum -= from[u - kSmoothedReach - 1];
  });
  return out;
}

/// Over the `kSmoothedReach` pixels above and below.
Counts sumsAlongColumns(const Counts& in) {
  Counts out(in.width_px, in.height_px);
  const int width = in.width_px;
  parallelRanges(in.height_px, kReliefBandRows, [&](int begin, int end) {
    std::vector<std::int32_t> sums(static_cast<std::size_t>(width), 0);
    std::int32_t* sum = sums.data();
    for (int v = std::max(begin - kSmoothedReach, 0);
         v < std::min(begin + kSmoothedReach, in.height_px); ++v) {
      const std::int32_t* row = in.row(v);
      for (int u = 0; u < width; ++u) sum[u] += row[u];
    }
    const std::vector<std::int32_t> zeros(static_cast<std::size_t>(width), 0);
    const auto rowOrZeros = [&](int v) {
      return v >= 0 && v < in.height_px ? in.row(v) : zeros.data();
    };
    for (int v = begin; v < end; ++v) {
      const std::int32_t *comes = rowOrZeros(v + kSmoothedReach),
                         *goes = rowOrZeros(v - kSmoothedReach);
      std::int32_t* to = out.row(v);
      for (int u = 0; u < width; ++u) {
        to[u] = sum[u] + comes[u];
        sum[u] = to[u] - goes[u];
      }
    }
  });
  return out;
}

Counts windowSums(const Counts& in) { return sumsAlongColumns(sumsAlongRows(in)); }

}  // namespace

float sigmaWithRelief(const RectifiedRig& rig, float sigma_mm, float depth_mm, float error_px) {
  if (std::isnan(error_px)) return sigma_mm;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  return std::hypot(sigma_mm, depth_mm * depth_mm / scale * error_px);
}

Raster<float> reliefErrorPx(const Raster<float>& depth_mm, const RectifiedRig& rig) {
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  constexpr float kLargest = static_cast<float>(StereoOptions::kLargestDisparityPx);
  Counts measured(width, height, 0), steps(width, height, 0);
  parallelRows(height, [&](int v) {
    const float* z = depth_mm.row(v);
    std::int32_t *is_measured = measured.row(v), *step = steps.row(v);
    for (int u = 0; u < width; ++u) {
      is_measured[u] = z[u] > 0 ? 1 : 0;
      step[u] = rounded(z[u] > 0 ? kStepsPerPx * std::min(scale / z[u], kLargest) : 0.0f);
    }
  });
  const Counts counts = windowSums(measured), means = windowSums(steps);
  Counts squares(width, height, 0);
  parallelRows(height, [&](int v) {
    const std::int32_t *is_measured = measured.row(v), *step = steps.row(v), *sum = means.row(v),
                       *count = counts.row(v);
    std::int32_t* square = squares.row(v);
    for (int u = 0; u < width; ++u) {
      const double bend_px =
          (step[u] - static_cast<double>(sum[u]) / std::max(count[u], 1)) / kStepsPerPx;
      square[u] = is_measured[u] *
                  rounded(kStepsAPx2 * std::min<double>(bend_px * bend_px, kLargestBendPx2));
    }
  });
  const Counts energies = windowSums(squares);
  Raster<float> error_px(width, height, std::numeric_limits<float>::quiet_NaN());
  parallelRows(height, [&](int v) {
    const std::int32_t *is_measured = measured.row(v), *energy = energies.row(v),
                       *count = counts.row(v);
    float* error = error_px.row(v);
    for (int u = 0; u < width; ++u)
      if (is_measured[u] != 0)
        error[u] =
            std::sqrt(static_cast<float>(energy[u]) / (kStepsAPx2 * static_cast<float>(count[u])));
  });
  return error_px;
}

void addReliefError(const RectifiedRig& rig, DisparityMap* disparity, DepthMap* depth) {
  if (depth->sigma_mm.empty()) return;
  const Raster<float> error_px = reliefErrorPx(depth->depth_mm, rig);
  parallelRows(error_px.height_px, [&](int v) {
    for (int u = 0; u < error_px.width_px; ++u) {
      const float error = error_px.at(u, v);
      if (std::isnan(error)) continue;
      float& sigma_mm = depth->sigma_mm.at(u, v);
      sigma_mm = sigmaWithRelief(rig, sigma_mm, depth->depth_mm.at(u, v), error);
      if (disparity == nullptr || disparity->sigma_px.empty()) continue;
      float& sigma_px = disparity->sigma_px.at(u, v);
      sigma_px = std::hypot(sigma_px, error);
    }
  });
}

}  // namespace softscope
