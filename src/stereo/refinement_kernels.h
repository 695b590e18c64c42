// src/stereo/refinement_kernels.h: the inner loops of sub-pixel refinement: residuals, moments,
// planes.
//
// Compiled once for each instruction set (kernel_sets.h). Raw pointers only: a header-only
// container compiled with AVX2 could be picked by the linker for the whole program. Floating point
// is never contracted, so that every set gives the same bytes.
#pragma once

namespace softscope {

/// Inputs and outputs of one row of brightness residuals, see subpixel_refinement.cpp.
struct ResidualRow {
  const float* left;       // filtered brightness of the left row
  const float* right;      // of the right row; readable from -2 to width + 2
  const float* disparity;  // 0 where unmatched
  const float* valid;      // 1 or 0
  int width;
  float inverse_noise_sq;  // 1 / noise²
  float prior_weight;      // (noise / prior sigma)²
  float* information;      // w (g² + prior_weight)
  float* target;           // w (g (g d + R - L) + prior_weight d)
  float* residual_sq;      // w (R - L)²
  float* weight;           // w
  float* difference_sq;    // (R - L)² where matched, whatever its weight
  float* energy;           // R² + L² where matched
};

/// Sums over the window of each pixel of a row: six moments of its information (1, x, y, x², xy,
/// y²), three of its target (1, x, y), then residual_sq, weight, difference_sq and energy.
constexpr int kMomentCount = 13;
struct MomentRow {
  float* sums[kMomentCount];
};

/// A row of planes: solvePlanes() needs nine sums and gives disparities, judgePlanes() all of them
/// and gives standard errors.
struct PlaneRow {
  MomentRow moments;
  const float* before;  // disparity, NaN = unmatched
  int width;
  float farthest_step_px;  // NaN where the plane lies farther off
  float prior_weight;      // see ResidualRow
  float noise_floor_sq;
  float independent_pixels;  // of the window
  float model_variance_px2;
  float max_variance_px2;  // NaN where the variance is larger
  float max_difference;    // NaN where difference_sq is a larger share of the energy
  float relaxation;        // share of the step to take; above 1 converges faster
  float* disparity;
  float* sigma;
};

/// The same moments at one pixel, from those pixels of its window that lie on its own surface:
/// their disparity differs by no more than the tolerance. Rows are `stride` floats apart, the
/// pointers stand on the centre, `window` holds kSelectLanes weights a row, 0 beyond the radius.
constexpr int kSelectLanes = 16;
struct SelectedWindow {
  const float* information;
  const float* target;
  const float* residual_sq;
  const float* weight;
  const float* difference_sq;
  const float* energy;
  const float* disparity;
  int stride;
  const float* window;     // (2 r + 1) x kSelectLanes
  const float* tolerance;  // of the disparity, same shape
  int radius;
};

struct RefinementKernels {
  void (*residualRow)(const ResidualRow& row);
  /// Horizontal moments: out_k[u] = sum over x in [-r, r] of w[x] x^k in[u + x], k = 0, 1, 2.
  void (*horizontalMoments)(const float* in, const float* window, int radius, int width,
                            float* out_0, float* out_1, float* out_2);
  /// Vertical moments of the rows v - r .. v + r (2 r + 1 pointers each).
  void (*verticalMoments)(const float* const* g_0, const float* const* g_1, const float* const* g_2,
                          const float* const* q_0, const float* const* q_1, const float* window,
                          int radius, int width, const MomentRow& out);
  /// Writes column u of `out`.
  void (*selectedMoments)(const SelectedWindow& at, int u, const MomentRow& out);
  void (*solvePlanes)(const PlaneRow& row);
  void (*judgePlanes)(const PlaneRow& row);  // after solvePlanes()
  /// sum over taps of weight[t] * in[t][u]; out[u], u in [0, width).
  void (*sumRows)(const float* const* in, const float* weights, int taps, int width, float* out);
};

}  // namespace softscope
