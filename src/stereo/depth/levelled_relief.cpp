#include "stereo/depth/levelled_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr int kOneWindowPx = 2 * RefinementOptions::radius_px + 1;   // of stereo
constexpr int kTwoWindowsPx = 4 * RefinementOptions::radius_px + 1;  // one after the other
constexpr int kReach = (kTwoWindowsPx / 2) / LevelledRelief::kStepPx;
/// Of what the mean over two windows takes from a bend that is alike everywhere, one window does.
constexpr double kOneOfTwo =
    static_cast<double>(kOneWindowPx * kOneWindowPx) / (kTwoWindowsPx * kTwoWindowsPx);

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
        std::isnan(in.values[i]) ? kUnknown : static_cast<float>(sums.values[i] / counts.values[i]);
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

}  // namespace

Raster<float> depthOfSquares(const Raster<float>& depth_mm) {
  constexpr int step = LevelledRelief::kStepPx;
  Raster<float> coarse(depth_mm.width_px / step, depth_mm.height_px / step);
  for (int v = 0; v < coarse.height_px; ++v)
    for (int u = 0; u < coarse.width_px; ++u)
      coarse.at(u, v) = depth_mm.at(step * u + step / 2, step * v + step / 2);
  return coarse;
}

LevelledRelief levelledRelief(Raster<float> depth_mm, const RectifiedRig& rig) {
  LevelledRelief relief;
  relief.depth_mm = std::move(depth_mm);
  const double scale = rig.left.fx_px * rig.baseline_mm;
  Raster<float> disparity_px = relief.depth_mm;
  for (float& value : disparity_px.values) value = static_cast<float>(scale / value);
  relief.variance_mm2 = reliefVariance(disparity_px);
  for (std::size_t i = 0; i < relief.variance_mm2.size(); ++i) {
    const double mm_per_px = relief.depth_mm.values[i] * (relief.depth_mm.values[i] / scale);
    relief.variance_mm2.values[i] *= static_cast<float>(mm_per_px * mm_per_px);
  }
  return relief;
}

}  // namespace softscope
