// src/stereo/kernels/smoothing_formulas.h: formulas of patch smoothing, for the CPU and the GPU.
#pragma once

#include <cmath>
#include <vector>

#include "core/hd.h"
#include "core/small_solve.h"
#include "stereo/kernels/filter_formulas.h"
#include "stereo/kernels/patch_formulas.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// The mean of a square of pixels.
struct SmoothingBlock {
  float u = 0, v = 0, disparity_px = 0;
  float information = 0;  // sum of 1 / sigma^2 over its pixels; 0: nothing was measured
  float variance = 0;     // of a typical pixel, the harmonic mean

  SOFTSCOPE_HD bool known() const { return information > 0; }
};

/// d(u, v) = c . (1, x, y, x², xy, y²), x and y from (u0, v0) in windows.
struct SmoothingPatch {
  float u0 = 0, v0 = 0;
  float c[6] = {0, 0, 0, 0, 0, 0};
  float variance = 0;  // of what it predicts for a pixel; 0: there is no patch

  SOFTSCOPE_HD bool known() const { return variance > 0; }
};

/// What all pixels share; by value, so that kernels take it along.
struct SmoothingRules {
  static constexpr float kStepPx = 0.5f;     // neighbours of one surface differ by at most this …
  static constexpr float kSlope = 0.25f;     // … and this much more for every pixel between them
  static constexpr float kFewestPixels = 4;  // of a block that counts
  static constexpr float kRidge = 1e-3f;     // of the weights: patches through a line stay level
  static constexpr int kFits = 2;            // first to near blocks, then to those that agree

  int size;               // of a block, in pixels
  int reach;              // of a window, in blocks
  float scale;            // windows a pixel
  float independent_px2;  // area within which errors are alike
  float floor_px2;        // variance that no fit removes
  int columns, rows;      // blocks
};

inline SmoothingRules smoothingRules(const SmoothingOptions& options,
                                     const RefinementOptions& refinement, int width_px,
                                     int height_px) {
  SmoothingRules rules{};
  rules.size = options.blockPx(width_px);
  rules.reach = options.reach_blocks;
  rules.scale = 1 / static_cast<float>(rules.reach * rules.size);
  rules.independent_px2 =
      static_cast<float>(refinement.independentPx2() / RefinementOptions::kNoiseWithRelief);
  rules.floor_px2 = static_cast<float>(refinement.model_sigma_px * refinement.model_sigma_px +
                                       options.relief_px * options.relief_px);
  rules.columns = (width_px + rules.size - 1) / rules.size;
  rules.rows = (height_px + rules.size - 1) / rules.size;
  return rules;
}

/// Weights of the (2 reach + 1)² blocks of a window, row by row.
inline std::vector<float> smoothingWindow(int reach) {
  const float spread = 0.5f * static_cast<float>(reach);
  std::vector<float> window;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      window.push_back(std::exp(-0.5f * static_cast<float>(dx * dx + dy * dy) / (spread * spread)));
  return window;
}

/// Weight of a pixel in the mean of its block; 0 where it is unmeasured.
SOFTSCOPE_FORMULA float smoothingWeight(float disparity_px, float sigma_px) {
  return isNumber(disparity_px) && sigma_px > 0 ? 1 / (sigma_px * sigma_px) : 0.0f;
}
/// Sums over a block's pixels in raster order: their count, weights, and weighted column, row and
/// disparity, from the first pixel (u0, v0).
struct SmoothingSums {
  float count = 0, w = 0, wu = 0, wv = 0, wd = 0;
};
SOFTSCOPE_FORMULA SmoothingBlock blockFromSums(const SmoothingSums& sums, int u0, int v0) {
  SmoothingBlock block;
  if (sums.count < SmoothingRules::kFewestPixels) return block;
  block.u = static_cast<float>(u0) + sums.wu / sums.w;
  block.v = static_cast<float>(v0) + sums.wv / sums.w;
  block.disparity_px = sums.wd / sums.w;
  block.information = sums.w;
  block.variance = sums.count / sums.w;
  return block;
}

/// One step of least squares, reweighted by which blocks agree. False: there is no patch.
SOFTSCOPE_HD inline bool refitPatch(const SmoothingRules& rules, const SmoothingBlock* blocks,
                                    const float* window, int x, int y, bool first,
                                    SmoothingPatch& patch) {
  float normal[triangleSize(6)] = {}, right[6] = {};
  float weights = 0, squares = 0, noise = 0;
  for (int dy = -rules.reach; dy <= rules.reach; ++dy) {
    if (y + dy < 0 || y + dy >= rules.rows) continue;
    for (int dx = -rules.reach; dx <= rules.reach; ++dx) {
      if (x + dx < 0 || x + dx >= rules.columns) continue;
      const SmoothingBlock other = blocks[(y + dy) * rules.columns + x + dx];
      if (!other.known()) continue;
      const float du = other.u - patch.u0, dv = other.v - patch.v0;
      const float xs = du * rules.scale, ys = dv * rules.scale;
      const float row[6] = {1, xs, ys, xs * xs, xs * ys, ys * ys};
      float predicted = 0;
      for (int k = 0; k < 6; ++k) predicted += patch.c[k] * row[k];
      const float residual = other.disparity_px - predicted;
      float trust = window[(dy + rules.reach) * (2 * rules.reach + 1) + dx + rules.reach];
      if (first) {
        const float apart = std::sqrt(du * du + dv * dv);
        if (absoluteOf(residual) > SmoothingRules::kStepPx + SmoothingRules::kSlope * apart)
          continue;
      } else {
        const float q =
            1 + residual * residual / (kPatchAgreeSq * (patch.variance + other.variance));
        trust *= 1 / (q * q);
      }
      const float weight = trust * other.information;
      for (int i = 0; i < 6; ++i) {
        const float weighted = weight * row[i];
        for (int j = 0; j <= i; ++j) normal[i * (i + 1) / 2 + j] += weighted * row[j];
        right[i] += (weight * residual) * row[i];
      }
      weights += weight;
      squares += weight * residual * residual;
      noise += weight * other.variance;
    }
  }
  if (!(weights > 0)) return false;
  for (int i = 1; i < 6; ++i) normal[i * (i + 1) / 2 + i] += SmoothingRules::kRidge * weights;
  if (!factorSymmetric<6>(normal)) return false;
  float step[6], unit[6] = {1, 0, 0, 0, 0, 0}, explained = 0;
  for (int k = 0; k < 6; ++k) step[k] = right[k];
  solveSymmetric<6>(normal, step);
  bool finite = true;
  for (int k = 0; k < 6; ++k) {
    explained += step[k] * right[k];
    patch.c[k] += step[k];
    finite = finite && step[k] - step[k] == 0;
  }
  // The residuals that are left, by the normal equations.
  const float unexplained = squares - explained;
  const float left = (unexplained > 0 ? unexplained : 0.0f) / weights;
  const float beyond = left - noise / weights, relief = beyond > 0 ? beyond : 0.0f;
  // Of the centre: how much the fit leaves undetermined, for independent measurements.
  solveSymmetric<6>(normal, unit);
  patch.variance = rules.floor_px2 + relief + rules.independent_px2 * unit[0];
  return finite;
}

SOFTSCOPE_HD inline SmoothingPatch fitPatch(const SmoothingRules& rules,
                                            const SmoothingBlock* blocks, const float* window,
                                            int x, int y) {
  const SmoothingBlock centre = blocks[y * rules.columns + x];
  SmoothingPatch patch;
  if (!centre.known()) return patch;
  patch.u0 = centre.u;
  patch.v0 = centre.v;
  patch.c[0] = centre.disparity_px;
  for (int i = 0; i < SmoothingRules::kFits; ++i)
    if (!refitPatch(rules, blocks, window, x, y, i == 0, patch)) return SmoothingPatch();
  return patch;
}

/// A pixel drawn to the weighted mean of its patches: see shareOfPixel().
struct SmoothedPixel {
  float disparity_px, sigma_px;
};
SOFTSCOPE_HD inline SmoothedPixel drawToPatches(float disparity_px, float sigma_px, float weights,
                                                float variances, float predictions) {
  const float share = shareOfPixel(sigma_px * sigma_px, weights, variances);
  return {drawnDisparity(disparity_px, share, weights, predictions), sigma_px * std::sqrt(share)};
}

}  // namespace softscope
