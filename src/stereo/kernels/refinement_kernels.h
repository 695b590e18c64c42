// src/stereo/kernels/refinement_kernels.h: the inner loops of sub-pixel refinement:
// residuals, moments, planes. Compiled once for each instruction set
// (stereo_kernels.h). Raw pointers only: a header-only container compiled with AVX2
// could be picked by the linker for the whole program. Floating point is never
// contracted, so that every set gives the same bytes. Rows are processed up to eight
// values at a time: all must be readable and writable up to the next multiple of
// eight.
#pragma once

#include "stereo/kernels/light_formulas.h"

namespace softscope {

/// Weights of residuals.
struct ResidualLimits {
  float inverse_noise_sq;  // 1 / noise²
  float prior_weight;      // (noise / prior sigma)²
  float light_gray_sq;     // see agreedSlowPart()
  float steadying;         // of the low-pass part, which is no evidence, in prior weights
  float of_disparity;      // 1: planes fit the disparity, 0: the remaining difference
};

/// Inputs and outputs of one row of brightness residuals, see subpixel_refinement.cpp.
struct ResidualRow {
  const float* left;       // filtered brightness of the left row
  const float* right;      // of the right row; readable from -1 to width + 2
  const float* slow_left;  // low-pass parts; the right one readable as `right`
  const float* slow_right;
  LightRow light;
  const float* disparity;  // NaN if unmatched
  int width;
  ResidualLimits limits;
  float* information;  // w (g² + prior_weight)
  float* target;       // w (g (g d + R - L) + prior_weight d), d = 0 for a difference
  // Terms of the error estimate, all null but in the last step.
  float* residual_sq;    // w' (R - L)²
  float* weight;         // w' = w (1 + steadying * information of the low-pass part)
  float* difference_sq;  // (R - L)² of matched pixels, independent of weight
  float* energy;         // R² + L² of matched pixels
};

/// Sums along the columns of a window: three moments of information (1, y, y²), two of target.
constexpr int kColumnMomentCount = 5;

/// Sums over the window of each pixel of a row: six moments of its information (1, x, y, x²,
/// xy, y²), three of its target (1, x, y), then residual_sq, weight, difference_sq and energy.
constexpr int kMomentCount = 13;
constexpr int kFirstEvidence = 9;
struct MomentRow {
  float* sums[kMomentCount];
};

/// A row of planes: solvePlanes() needs nine sums and gives disparities, estimatePlaneErrors() all
/// of them and gives standard errors.
struct PlaneRow {
  MomentRow moments;
  const float* before;  // disparity, NaN = unmatched
  int width;
  float of_disparity;      // see ResidualLimits
  float farthest_step_px;  // NaN if the plane is farther away
  float prior_weight;      // see ResidualRow
  float noise_floor_sq;
  float independent_pixels;  // of the window
  float model_variance_px2;
  float max_variance_px2;  // NaN if the variance is larger
  float max_difference;    // NaN if difference_sq is a larger share of the energy
  float relaxation;        // share of the step applied; above 1 converges faster
  float* disparity;
  float* sigma;
  float* response;        // reliefResponse()
  float *beside, *below;  // EvidenceCentre; null if it is not wanted
};

/// Windows near a depth step: of each, the pixels on the surface of the
/// centre count, whose disparity differs by at most the tolerance. Each array
/// holds the rows v - r .. v + r (2 r + 1 pointers); window and tolerance
/// have kSelectLanes values per row, 0 and infinity beyond the radius.
constexpr int kSelectLanes = 16;
struct SelectedRows {
  const float* const* disparity;  // NaN = unmatched
  const float* const* information;
  const float* const* target;
  const float* const* evidence[4];  // residual_sq … energy; null but in the last step
  const float* window;
  const float* tolerance;
  bool relative;  // the tolerance is a share of the centre value
  int radius;
};

/// A row of disparities with relief that its steps returned to those of the planes. shrinkRelief()
/// keeps the share of it that reliefGain() gives, and of the rest what is smooth.
struct ReliefRow {
  const float* planes;  // disparity of the planes, NaN = unmatched
  const float* smooth;  // smoothRelief(), for shrinkRelief()
  float* disparity;     // with relief, NaN = unmatched
  float* sigma;         // of the planes
  int width;
  // Of a pixel, or sums over its window; 0 for an unmatched pixel.
  float* relief_sq;  // (disparity - planes)²
  float* noise_sq;   // sigma² without the error that is independent of texture
  float model_variance_px2;
};

struct RefinementKernels {
  void (*residualRow)(const ResidualRow& row);
  /// out_k[u] = sum over y in [-r, r] of w[y] y^k in[y + r][u]: k = 0, 1, 2 of `information`, then
  /// k = 0, 1 of `target`.
  void (*columnMoments)(const float* const* information, const float* const* target,
                        const float* window, int radius, int width, float* const* out);
  /// The same along the row, of the results of columnMoments(); readable `radius` beyond both ends.
  void (*rowMoments)(const float* const* in, const float* window, int radius, int width,
                     const MomentRow& out);
  /// mixed[u] = 1 for those of `count` columns u whose windows contain pixels
  /// of another surface, otherwise 0; the rest of `mixed` is unchanged.
  void (*markMixed)(const SelectedRows& rows, const int* columns, int count, unsigned char* mixed);
  /// Replaces the moments of `count` columns whose windows contain pixels of another surface.
  void (*selectedMoments)(const SelectedRows& rows, const int* columns, int count,
                          const MomentRow& out);
  void (*solvePlanes)(const PlaneRow& row);
  void (*estimatePlaneErrors)(const PlaneRow& row);  // after solvePlanes()
  void (*measureRelief)(const ReliefRow& row);       // relief_sq and noise_sq of each pixel
  void (*shrinkRelief)(const ReliefRow& row);        // from their sums
  /// sum over taps of weight[t] * in[t][u]; out[u], u in [0, width).
  void (*sumRows)(const float* const* in, const float* weights, int taps, int width, float* out);
};

}  // namespace softscope
