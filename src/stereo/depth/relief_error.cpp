#include "stereo/depth/relief_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/depth/relief_formulas.h"

namespace softscope {
namespace {

// Prefix sums may overflow, differences of unsigned ones are right nevertheless.
using Counts = Raster<std::uint32_t>;
using Pairs = Raster<std::uint64_t>;  // reliefPair()

constexpr int kReliefBand = 48;  // rows or columns of one task

/// Pixels of a window before and after its centre, up to `kSmoothedReach`, in one direction.
struct Extents {
  Raster<std::uint8_t> before, after;
};

/// Counts pixels since the last depth step between measured pixels, here with the first; `last`:
/// disparity of the last measured pixel; 0: none.
void extendRun(std::uint32_t disparity, std::uint32_t* length, std::uint32_t* last) {
  const bool begins = disparity != 0 && *last != 0 && isReliefStep(disparity, *last);
  constexpr std::uint32_t kMost = kSmoothedReach + 1;
  const std::uint32_t longer = *length + 1 < kMost ? *length + 1 : kMost;
  *length = begins ? 1 : longer;
  *last = disparity != 0 ? disparity : *last;
}

/// Windows end at the border of the image and at depth steps.
Extents extentsAlongRows(const Counts& disparity) {
  Extents extents{{disparity.width_px, disparity.height_px},
                  {disparity.width_px, disparity.height_px}};
  parallelRows(disparity.height_px, [&](int v) {
    const auto extend = [&](int u, std::uint32_t* length, std::uint32_t* last) {
      extendRun(disparity.at(u, v), length, last);
      return static_cast<std::uint8_t>(*length - 1);
    };
    std::uint32_t length = 0, last = 0;
    for (int u = 0; u < disparity.width_px; ++u)
      extents.before.at(u, v) = extend(u, &length, &last);
    length = last = 0;
    for (int u = disparity.width_px - 1; u >= 0; --u)
      extents.after.at(u, v) = extend(u, &length, &last);
  });
  return extents;
}

Extents extentsAlongColumns(const Counts& disparity) {
  const int height = disparity.height_px;
  Extents extents{{disparity.width_px, height}, {disparity.width_px, height}};
  parallelRanges(disparity.width_px, kReliefBand, [&](int begin, int end) {
    std::vector<std::uint32_t> length(static_cast<std::size_t>(end - begin), 0), last(length);
    // No branch, and no byte in the loop: several columns at a time.
    std::uint32_t *lengths = length.data(), *lasts = last.data();
    const auto extend = [&](int v, Raster<std::uint8_t>* to) {
      const std::uint32_t* from = disparity.row(v) + begin;
      for (int k = 0; k < end - begin; ++k) extendRun(from[k], lengths + k, lasts + k);
      std::uint8_t* reach = to->row(v) + begin;
      for (int k = 0; k < end - begin; ++k) reach[k] = static_cast<std::uint8_t>(lengths[k] - 1);
    };
    for (int v = 0; v < height; ++v) extend(v, &extents.before);
    std::fill(length.begin(), length.end(), 0);
    std::fill(last.begin(), last.end(), 0);
    for (int v = height - 1; v >= 0; --v) extend(v, &extents.after);
  });
  return extents;
}

/// Sum of the values from `before` places before the middle to `after` behind it; prefixAt(k): of
/// the first k.
template <ReliefSides kSides, class PrefixAt>
std::uint64_t sumWithin(int middle, int before, int after, const PrefixAt& prefixAt) {
  if (kSides == ReliefSides::kEven) before = after = std::min(before, after);
  return prefixAt(middle + 1 + after) - prefixAt(middle - before);
}

/// None at pixels that are not measured, which may be in the gap of a step.
template <ReliefSides kSides>
Pairs sumsAlongRows(const Pairs& in, const Extents& extents) {
  Pairs out(in.width_px, in.height_px);
  parallelRanges(in.height_px, kReliefBand, [&](int begin, int end) {
    std::vector<std::uint64_t> prefix(static_cast<std::size_t>(in.width_px) + 1, 0);
    for (int v = begin; v < end; ++v) {
      const std::uint64_t* from = in.row(v);
      for (int u = 0; u < in.width_px; ++u) prefix[u + 1] = prefix[u] + from[u];
      const std::uint8_t *before = extents.before.row(v), *after = extents.after.row(v);
      std::uint64_t* to = out.row(v);
      for (int u = 0; u < in.width_px; ++u)
        to[u] = reliefCount(from[u]) != 0
                    ? sumWithin<kSides>(u, before[u], after[u], [&](int at) { return prefix[at]; })
                    : 0;
    }
  });
  return out;
}

template <ReliefSides kSides>
Pairs sumsAlongColumns(const Pairs& in, const Extents& extents) {
  Pairs prefix(in.width_px, in.height_px + 1), out(in.width_px, in.height_px);
  parallelRanges(in.width_px, kReliefBand, [&](int begin, int end) {
    std::fill(prefix.row(0) + begin, prefix.row(0) + end, 0);
    for (int v = 0; v < in.height_px; ++v)
      for (int u = begin; u < end; ++u) prefix.at(u, v + 1) = prefix.at(u, v) + in.at(u, v);
  });
  parallelRows(in.height_px, [&](int v) {
    const std::uint8_t *before = extents.before.row(v), *after = extents.after.row(v);
    std::uint64_t* to = out.row(v);
    for (int u = 0; u < in.width_px; ++u)
      to[u] = sumWithin<kSides>(v, before[u], after[u], [&](int at) { return prefix.at(u, at); });
  });
  return out;
}

/// Windows around each pixel that end at depth steps: Zhang, Lu and Lafruit, "Cross-based local
/// stereo matching using orthogonal integral images", 2009.
struct Windows {
  Extents rows, columns;
};

Windows windowsOf(const Counts& disparity) {
  Windows windows;
  parallelInvoke([&] { windows.rows = extentsAlongRows(disparity); },
                 [&] { windows.columns = extentsAlongColumns(disparity); });
  return windows;
}

template <ReliefSides kSides>
Pairs sumsOver(const Windows& windows, const Pairs& in) {
  return sumsAlongColumns<kSides>(sumsAlongRows<kSides>(in, windows.rows), windows.columns);
}

}  // namespace

float sigmaWithRelief(const RectifiedRig& rig, float sigma_mm, float depth_mm, float error_px) {
  if (std::isnan(error_px)) return sigma_mm;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  return std::hypot(sigma_mm, depth_mm * depth_mm / scale * error_px);
}

Raster<float> reliefErrorPx(const Raster<float>& depth_mm, const RectifiedRig& rig) {
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  const float scale = static_cast<float>(rig.left.fx_px * rig.baseline_mm);
  Counts steps(width, height, 0);
  Pairs pairs(width, height, 0);
  parallelRows(height, [&](int v) {
    const float* z = depth_mm.row(v);
    std::uint32_t* step = steps.row(v);
    std::uint64_t* pair = pairs.row(v);
    for (int u = 0; u < width; ++u) {
      step[u] = disparitySteps(z[u], scale);
      pair[u] = z[u] > 0 ? reliefPair(step[u]) : 0;
    }
  });
  const Windows windows = windowsOf(steps);
  const Pairs means = sumsOver<ReliefSides::kEven>(windows, pairs);
  parallelRows(height, [&](int v) {
    const std::uint32_t* step = steps.row(v);
    const std::uint64_t* sum = means.row(v);
    std::uint64_t* pair = pairs.row(v);
    for (int u = 0; u < width; ++u)
      pair[u] = reliefCount(pair[u]) != 0 ? bendPair(step[u], sum[u]) : 0;
  });
  const Pairs energies = sumsOver<ReliefSides::kBoth>(windows, pairs);
  Raster<float> error_px(width, height, std::numeric_limits<float>::quiet_NaN());
  parallelRows(height, [&](int v) {
    const std::uint64_t *pair = pairs.row(v), *energy = energies.row(v);
    float* error = error_px.row(v);
    for (int u = 0; u < width; ++u)
      if (reliefCount(pair[u]) != 0) error[u] = reliefErrorOf(energy[u]);
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
