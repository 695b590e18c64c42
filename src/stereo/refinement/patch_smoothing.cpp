#include "stereo/refinement/patch_smoothing.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "stereo/kernels/smoothing_formulas.h"
#include "stereo/kernels/stereo_kernels.h"

namespace softscope {
namespace {

SmoothingBlock meanOf(const DisparityMap& map, int u0, int v0, int size) {
  SmoothingSums sums;
  const int v1 = std::min(v0 + size, map.disparity_px.height_px),
            u1 = std::min(u0 + size, map.disparity_px.width_px);
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) {
      const float d = map.disparity_px.at(u, v);
      const float weight = smoothingWeight(d, map.sigma_px.at(u, v));
      if (!(weight > 0)) continue;
      sums.count += 1;
      sums.w += weight;
      sums.wu += weight * static_cast<float>(u - u0);
      sums.wv += weight * static_cast<float>(v - v0);
      sums.wd += weight * d;
    }
  return blockFromSums(sums, u0, v0);
}

class Patches {
 public:
  Patches(const SmoothingOptions& options, const RefinementOptions& refinement,
          const DisparityMap& map)
      : rules_(smoothingRules(options, refinement, map.disparity_px.width_px,
                              map.disparity_px.height_px)),
        blocks_(rules_.columns, rules_.rows),
        patches_(rules_.columns, rules_.rows) {
    parallelRows(rules_.rows, [&](int y) {
      for (int x = 0; x < rules_.columns; ++x)
        blocks_.at(x, y) = meanOf(map, x * rules_.size, y * rules_.size, rules_.size);
    });
    const std::vector<float> window = smoothingWindow(rules_.reach);
    parallelRanges(rules_.rows, 1, [&](int begin, int end) {  // a row is work enough
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < rules_.columns; ++x)
          patches_.at(x, y) = fitPatch(rules_, blocks_.row(0), window.data(), x, y);
    });
  }

  /// Draws a row of pixels to what the four patches around each say, as far as it agrees with them.
  /// A register beyond the row is read and written.
  void smoothRow(int v, int width, float* disparity_px, float* sigma_px) const {
    const auto [y0, down] = cellPosition(v, rules_.size);
    for (int begin = 0; begin < width;) {
      const int x0 = cellPosition(begin, rules_.size).cell;
      int end = begin + 1;
      while (end < width && cellPosition(end, rules_.size).cell == x0) ++end;
      smoothingKernels().smoothCell(around(x0, y0, down), v, begin, end, disparity_px, sigma_px);
      begin = end;
    }
  }

 private:
  SmoothingCell around(int x0, int y0, float down) const {
    SmoothingCell cell{};
    cell.number = x0;
    cell.size = rules_.size;
    cell.scale = rules_.scale;
    for (int k = 0; k < 4; ++k) {
      const int x = x0 + k % 2, y = y0 + k / 2;
      const bool known = patches_.contains(x, y) && patches_.at(x, y).known();
      const SmoothingPatch patch = known ? patches_.at(x, y) : SmoothingPatch();
      const float share = known ? (k < 2 ? 1 - down : down) : 0.0f;
      cell.u0[k] = patch.u0;
      cell.v0[k] = patch.v0;
      for (int i = 0; i < 6; ++i) cell.c[i][k] = patch.c[i];
      cell.variance[k] = known ? patch.variance : 1.0f;
      cell.share_left[k] = k % 2 == 0 ? share : 0.0f;
      cell.share_right[k] = k % 2 == 0 ? 0.0f : share;
    }
    return cell;
  }

  SmoothingRules rules_;
  Raster<SmoothingBlock> blocks_;
  Raster<SmoothingPatch> patches_;
};

}  // namespace

void smoothByPatches(const SmoothingOptions& options, const RefinementOptions& refinement,
                     DisparityMap& map) {
  if (options.reach_blocks == 0) return;
  constexpr int kRowsPerTask = 16, kRegister = 16;
  const Patches patches(options, refinement, map);
  const int width = map.disparity_px.width_px;
  parallelRanges(map.disparity_px.height_px, kRowsPerTask, [&](int begin, int end) {
    std::vector<float> disparity_px(static_cast<std::size_t>(width + kRegister)),
        sigma_px(disparity_px.size());
    for (int v = begin; v < end; ++v) {
      std::copy_n(map.disparity_px.row(v), width, disparity_px.begin());
      std::copy_n(map.sigma_px.row(v), width, sigma_px.begin());
      patches.smoothRow(v, width, disparity_px.data(), sigma_px.data());
      std::copy_n(disparity_px.begin(), width, map.disparity_px.row(v));
      std::copy_n(sigma_px.begin(), width, map.sigma_px.row(v));
    }
  });
}

}  // namespace softscope
