#include "stereo/refinement/patch_smoothing.h"

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "stereo/kernels/smoothing_formulas.h"

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
  void smoothRow(int v, int width, float* disparity_px, float* sigma_px) const {
    const auto [y0, down] = cellPosition(v, rules_.size);
    int held = -1;  // the cell of the first pixel
    Quartet four = around(held, y0, down);
    for (int u = 0; u < width; ++u) {
      const auto [x0, right] = cellPosition(u, rules_.size);
      if (x0 != held) {
        held = x0;
        four = around(x0, y0, down);
      }
      if (isNumber(disparity_px[u]) && sigma_px[u] > 0)
        smooth(four, right, static_cast<float>(u), static_cast<float>(v), disparity_px[u],
               sigma_px[u]);
    }
  }

 private:
  using Array4f = Eigen::Array4f;

  /// Four neighbouring patches side by side: left, right, below left, below right.
  struct Quartet {
    Array4f u0, v0, c[6], variance;
    Array4f share_left, share_right;  // of each at the left and at the right end of the cell
  };

  Quartet around(int x0, int y0, float down) const {
    Quartet four;
    for (int k = 0; k < 4; ++k) {
      const int x = x0 + k % 2, y = y0 + k / 2;
      const bool known = patches_.contains(x, y) && patches_.at(x, y).known();
      const SmoothingPatch patch = known ? patches_.at(x, y) : SmoothingPatch();
      const float share = known ? (k < 2 ? 1 - down : down) : 0.0f;
      four.u0[k] = patch.u0;
      four.v0[k] = patch.v0;
      for (int i = 0; i < 6; ++i) four.c[i][k] = patch.c[i];
      four.variance[k] = known ? patch.variance : 1.0f;
      four.share_left[k] = k % 2 == 0 ? share : 0.0f;
      four.share_right[k] = k % 2 == 0 ? 0.0f : share;
    }
    return four;
  }

  void smooth(const Quartet& four, float right, float u, float v, float& disparity_px,
              float& sigma_px) const {
    const float variance = sigma_px * sigma_px;
    const Array4f x = (u - four.u0) * rules_.scale, y = (v - four.v0) * rules_.scale;
    const Array4f predicted = patchValue<Array4f>(four.c, x, y);
    const Array4f share = four.share_left * (1 - right) + four.share_right * right;
    const Array4f weight =
        patchWeight<Array4f>(share, disparity_px - predicted, four.variance, variance);
    const float weights = sumFour(weight);
    if (!(weights > 0)) return;
    const SmoothedPixel drawn =
        drawToPatches(disparity_px, sigma_px, weights, sumFour(Array4f(weight * four.variance)),
                      sumFour(Array4f(weight * predicted)));
    disparity_px = drawn.disparity_px;
    sigma_px = drawn.sigma_px;
  }

  SmoothingRules rules_;
  Raster<SmoothingBlock> blocks_;
  Raster<SmoothingPatch> patches_;
};

}  // namespace

void smoothByPatches(const SmoothingOptions& options, const RefinementOptions& refinement,
                     DisparityMap& map) {
  if (options.reach_blocks == 0) return;
  const Patches patches(options, refinement, map);
  parallelRows(map.disparity_px.height_px, [&](int v) {
    patches.smoothRow(v, map.disparity_px.width_px, map.disparity_px.row(v), map.sigma_px.row(v));
  });
}

}  // namespace softscope
