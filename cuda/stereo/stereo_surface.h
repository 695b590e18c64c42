// cuda/stereo/stereo_surface.h: kernel bodies of smooth depth and normals from disparity.
#pragma once

#include <cmath>

#include "core/camera.h"
#include "cuda/device/kernel.h"
#include "cuda/stereo/stereo_refinement.h"
#include "stereo/kernels/filter_formulas.h"
#include "stereo/kernels/refinement_formulas.h"
#include "stereo/kernels/smoothing_formulas.h"

namespace softscope::cuda {

// --- smoothing
// -------------------------------------------------------------------------------------

/// Weights of a smoothing window, as kernel argument.
struct PatchWindow {
  static constexpr int kWidestReach = 7;
  float weights[(2 * kWidestReach + 1) * (2 * kWidestReach + 1)];
};

/// One thread block per block of pixels, kPixels at a time; one lane per sum, in raster order.
struct BlockMeanKernel {
  static constexpr int kThreads = 64, kPhases = 4, kPixels = 256, kSums = 5;
  struct Shared {
    float terms[kSums][kPixels];  // 0 where a pixel is unmeasured
    float sums[kSums];
  };
  struct Local {
    float sum;
  };
  View<const float> disparity, sigma;
  SmoothingRules rules;
  SmoothingBlock* blocks_out;

  Grid blocks() const { return {rules.columns, rules.rows, 1}; }
  SOFTSCOPE_HD int repeats(const Place&) const {
    return (rules.size * rules.size + kPixels - 1) / kPixels;
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const int u0 = at.x * rules.size, v0 = at.y * rules.size, first = at.repeat * kPixels;
    const int rest = rules.size * rules.size - first, count = rest < kPixels ? rest : kPixels;
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < count; i += kThreads)
        loadTerms(u0, v0, (first + i) % rules.size, (first + i) / rules.size, i, shared);
    } else if constexpr (kPhase == 1) {
      if (at.thread >= kSums) return;
      float sum = at.repeat == 0 ? 0.0f : local.sum;
      for (int i = 0; i < count; ++i) sum += shared.terms[at.thread][i];
      local.sum = sum;
    } else if constexpr (kPhase == 2) {
      if (at.thread < kSums) shared.sums[at.thread] = local.sum;
    } else if (at.thread == 0 && at.repeat + 1 == repeats(at)) {
      const float* s = shared.sums;
      blocks_out[at.y * rules.columns + at.x] =
          blockFromSums({s[0], s[1], s[2], s[3], s[4]}, u0, v0);
    }
  }

 private:
  SOFTSCOPE_HD void loadTerms(int u0, int v0, int x, int y, int i, Shared& shared) const {
    const bool inside = disparity.contains(u0 + x, v0 + y);
    const float d = inside ? disparity.at(u0 + x, v0 + y) : quietNan();
    const float weight = inside ? smoothingWeight(d, sigma.at(u0 + x, v0 + y)) : 0.0f;
    const bool counts = weight > 0;
    shared.terms[0][i] = counts ? 1.0f : 0.0f;
    shared.terms[1][i] = weight;
    shared.terms[2][i] = weight * static_cast<float>(x);
    shared.terms[3][i] = weight * static_cast<float>(y);
    shared.terms[4][i] = counts ? weight * d : 0.0f;
  }
};
/// One thread per patch.
struct FitPatchKernel {
  static constexpr int kThreads = 32, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  SmoothingRules rules;
  const SmoothingBlock* means;
  SmoothingPatch* patches;
  PatchWindow window;

  Grid blocks() const { return {blocksFor(rules.columns * rules.rows, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= rules.columns * rules.rows) return;
    patches[i] = fitPatch(rules, means, window.weights, i % rules.columns, i / rules.columns);
  }
};
/// Smooths each pixel with the four surrounding patches, as far as it agrees with them.
struct SmoothBody {
  SmoothingRules rules;
  const SmoothingPatch* patches;
  View<float> disparity, sigma;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const float d = disparity.at(u, v), s = sigma.at(u, v);
    if (!isNumber(d) || !(s > 0)) return;
    const CellPosition across = cellPosition(u, rules.size), down = cellPosition(v, rules.size);
    float weight[4], weighted_variance[4], weighted_value[4];
    for (int k = 0; k < 4; ++k) {
      const int x = across.cell + k % 2, y = down.cell + k / 2;
      SmoothingPatch patch;
      if (x >= 0 && y >= 0 && x < rules.columns && y < rules.rows)
        patch = patches[y * rules.columns + x];
      const bool known = patch.known();
      if (!known) patch = SmoothingPatch();
      const float variance = known ? patch.variance : 1.0f;
      const float vertical = known ? (k < 2 ? 1 - down.fraction : down.fraction) : 0.0f;
      const float share_left = k % 2 == 0 ? vertical : 0.0f,
                  share_right = k % 2 == 0 ? 0.0f : vertical;
      const float xs = (static_cast<float>(u) - patch.u0) * rules.scale,
                  ys = (static_cast<float>(v) - patch.v0) * rules.scale;
      const float value = patchValue(patch.c, xs, ys);
      const float share = share_left * (1 - across.fraction) + share_right * across.fraction;
      weight[k] = patchWeight(share, d - value, variance, s * s);
      weighted_variance[k] = weight[k] * variance;
      weighted_value[k] = weight[k] * value;
    }
    const float weights = sumFour(weight);
    if (!(weights > 0)) return;
    const SmoothedPixel drawn =
        drawToPatches(d, s, weights, sumFour(weighted_variance), sumFour(weighted_value));
    disparity.at(u, v) = drawn.disparity_px;
    sigma.at(u, v) = drawn.sigma_px;
  }
};

// --- erosion and depth
// -----------------------------------------------------------------------------

/// Per pixel, the disparity of a rim there.
struct FindRimsBody {
  View<const float> disparity;
  View<float> rims;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    rims.at(u, v) = rimDisparity([&](int x, int y) {
      return disparity.contains(u + x, v + y) ? disparity.at(u + x, v + y) : quietNan();
    });
  }
};
/// The least within their reach along the row.
struct LeastRimInRowBody {
  View<const float> rims;
  View<float> out;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    float least = kNoRim;
    for (int x = u - kRimReachPx; x <= u + kRimReachPx; ++x)
      if (x >= 0 && x < rims.width && rims.at(x, v) < least) least = rims.at(x, v);
    out.at(u, v) = least;
  }
};

/// Inputs of a frame besides its images.
struct FrameInputs {
  double roll_rad;  // of the right image, whose effect on disparity is removed
  int masked;       // 0: the mask is not in use
};

/// Removes pixels near depth steps, the border and the mask, doubts those at rims; back-projects
/// the others.
struct DepthBody {
  View<const float> disparity_in, sigma_in, rim_rows;
  View<const std::uint8_t> mask;
  const FrameInputs* inputs;
  View<float> disparity, sigma, depth, depth_sigma;
  int reach, border;
  float edge_step;
  double scale, offset_px;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    float d = disparity_in.at(u, v), s = sigma_in.at(u, v);
    if (isAtRim(d, leastRim(u, v))) s = sigmaAtRim(s);
    if (isDropped(u, v)) d = s = quietNan();
    const double centre_v = (disparity.height - 1) / 2.0;
    d -= static_cast<float>(inputs->roll_rad * (v - centre_v));
    float z = quietNan(), z_sigma = quietNan();
    const double shifted = d + offset_px;
    if (shifted > 0) {
      const DepthPixel pixel = depthOfDisparity(shifted, s, scale);
      z = pixel.depth_mm;
      z_sigma = pixel.sigma_mm;
    }
    if (inputs->masked != 0 && mask.at(u, v) != 0) d = s = z = z_sigma = quietNan();
    disparity.at(u, v) = d;
    sigma.at(u, v) = s;
    depth.at(u, v) = z;
    depth_sigma.at(u, v) = z_sigma;
  }

 private:
  SOFTSCOPE_HD bool isDropped(int u, int v) const {
    const int width = disparity.width, height = disparity.height;
    if (u < border || v < border || u >= width - border || v >= height - border) return true;
    // An edge is between a pixel and its neighbours to the right and below.
    bool found = false;
    for (int y = v - reach; y < v + reach; ++y)
      for (int x = u - reach; x < u + reach; ++x)
        if (disparity_in.contains(x, y)) found |= isEdge(x, y);
    return found;
  }
  SOFTSCOPE_HD float leastRim(int u, int v) const {
    float least = kNoRim;
    for (int y = v - kRimReachPx; y <= v + kRimReachPx; ++y)
      if (y >= 0 && y < rim_rows.height && rim_rows.at(u, y) < least) least = rim_rows.at(u, y);
    return least;
  }
  SOFTSCOPE_HD bool isEdge(int x, int y) const {
    const float here = disparity_in.at(x, y);
    const bool beside =
        x + 1 < disparity_in.width && absoluteOf(disparity_in.at(x + 1, y) - here) > edge_step;
    return beside || (y + 1 < disparity_in.height &&
                      absoluteOf(disparity_in.at(x, y + 1) - here) > edge_step);
  }
};

// --- normals
// ---------------------------------------------------------------------------------------

struct NormalPixel {
  float x, y, z;
};

/// Removes all measurements of masked pixels.
struct DropPixelBody {
  View<const std::uint8_t> mask;
  View<float> rasters[4];
  View<NormalPixel> normals;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    if (mask.at(u, v) == 0) return;
    for (const View<float>& raster : rasters) raster.at(u, v) = quietNan();
    normals.at(u, v) = {quietNan(), quietNan(), quietNan()};
  }
};

/// Plane fitted to the inverse depth around each pixel; one block: 32 x 16 pixels.
struct NormalKernel {
  static constexpr int kThreads = 256, kPhases = 3, kWidth = 32, kHeight = 16;
  static constexpr int kReach = kNormalReach, kSide = 2 * kReach + 1;
  static constexpr int kColumns = kWidth + 2 * kReach, kRows = kHeight + 2 * kReach;
  struct Shared {
    float inverse[kRows][kColumns];
    float columns[5][kHeight][kColumns];
    float low[kHeight][kColumns], high[kHeight][kColumns];
  };
  using Local = Nothing;
  View<const float> depth;
  View<NormalPixel> normals;
  float fx_px, fy_px, cx_px;
  double cy_px;

  Grid blocks() const {
    return {blocksFor(depth.width, kWidth), blocksFor(depth.height, kHeight), 1};
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < kColumns * kRows; i += kThreads) {
        const int u = at.x * kWidth - kReach + i % kColumns,
                  v = at.y * kHeight - kReach + i / kColumns;
        shared.inverse[i / kColumns][i % kColumns] =
            depth.contains(u, v) ? 1.0f / depth.at(u, v) : quietNan();
      }
    } else if constexpr (kPhase == 1) {
      for (int i = at.thread; i < kColumns * kHeight; i += kThreads)
        sumColumn(i % kColumns, i / kColumns, shared);
    } else {
      for (int i = at.thread; i < kWidth * kHeight; i += kThreads) {
        const int u = at.x * kWidth + i % kWidth, v = at.y * kHeight + i / kWidth;
        if (depth.contains(u, v))
          normals.at(u, v) = normalAt(u, v, i % kWidth + kReach, i / kWidth, shared);
      }
    }
  }

 private:
  SOFTSCOPE_HD void sumColumn(int x, int row, Shared& shared) const {
    const float window[kSide] = {1, 1, 1, 1, 1, 1, 1};
    const auto inverse = [&](int y) { return shared.inverse[row + kReach + y][x]; };
    float sums[5];
    columnMomentsOf([&](int y) { return isNumber(inverse(y)) ? 1.0f : 0.0f; },
                    [&](int y) { return isNumber(inverse(y)) ? inverse(y) : 0.0f; }, window, kReach,
                    sums);
    for (int k = 0; k < 5; ++k) shared.columns[k][row][x] = sums[k];
    float low = bitsAsFloat(0x7F800000u), high = -low;
    for (int y = -kReach; y <= kReach; ++y) {  // a comparison with NaN is false
      low = inverse(y) < low ? inverse(y) : low;
      high = inverse(y) > high ? inverse(y) : high;
    }
    shared.low[row][x] = low;
    shared.high[row][x] = high;
  }
  SOFTSCOPE_HD NormalPixel normalAt(int u, int v, int x, int row, const Shared& shared) const {
    const float window[kSide] = {1, 1, 1, 1, 1, 1, 1};
    const float inverse = shared.inverse[row + kReach][x];
    float m[9];
    windowMomentsOf([&](int k, int dx) { return shared.columns[k][row][x + dx]; }, window, kReach,
                    m);
    if (mixesSurfaces(inverse, x, row, shared)) selectMoments(inverse, x, row, shared, m);
    const auto plane =
        planeNormal(m, static_cast<float>(u) - cx_px, static_cast<float>(v - cy_px), fx_px, fy_px);
    const bool holds =
        isNumber(inverse) && m[0] >= kFewestNormalPixels && plane.determinant > 1e-3f;
    // Inverse depth is positive in front: -n points to the camera.
    const float scale =
        holds ? -1.0f / std::sqrt(plane.x * plane.x + plane.y * plane.y + plane.z * plane.z)
              : quietNan();
    return {plane.x * scale, plane.y * scale, plane.z * scale};
  }
  SOFTSCOPE_HD static bool mixesSurfaces(float centre, int x, int row, const Shared& shared) {
    float low = centre, high = centre;
    for (int dx = -kReach; dx <= kReach; ++dx) {
      low = shared.low[row][x + dx] < low ? shared.low[row][x + dx] : low;
      high = shared.high[row][x + dx] > high ? shared.high[row][x + dx] : high;
    }
    return high - centre > kNormalDepthStep * centre || centre - low > kNormalDepthStep * centre;
  }
  /// The moments of the pixels on the centre's surface, in the order of sumLanesOf().
  SOFTSCOPE_HD static void selectMoments(float centre, int x, int row, const Shared& shared,
                                         float (&m)[9]) {
    float four[9][4] = {};
    for (int lane = 0; lane < kSide; ++lane) {
      float g0 = 0, g1 = 0, g2 = 0, q0 = 0, q1 = 0;
      for (int y = 0; y < kSide; ++y) {
        const float value = shared.inverse[row + y][x - kReach + lane];
        const float w = absoluteOf(value - centre) <= centre * kNormalDepthStep ? 1.0f : 0.0f;
        const float g = w, q = w > 0 ? value : 0.0f, fy = static_cast<float>(y - kReach);
        g0 += g;
        g1 += fy * g;
        g2 += fy * fy * g;
        q0 += q;
        q1 += fy * q;
      }
      const float fx = static_cast<float>(lane - kReach);
      const float parts[9] = {g0, fx * g0, g1, fx * fx * g0, fx * g1, g2, q0, fx * q0, q1};
      for (int k = 0; k < 9; ++k) four[k][lane % 4] += parts[k];
    }
    for (int k = 0; k < 9; ++k) m[k] = (four[k][0] + four[k][2]) + (four[k][1] + four[k][3]);
  }
};

}  // namespace softscope::cuda
