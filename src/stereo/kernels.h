// src/stereo/kernels.h: the inner loops of stereo, compiled once for each instruction set.
//
// Raw pointers only: a header-only container compiled here with AVX2 could be picked by the linker
// for the whole program. Floating point is never contracted, so that every set gives the same
// bytes.
#pragma once

#include <cstdint>

namespace softscope {

/// Tile of the dense matcher; also the cell in which support disparities are shared.
constexpr int kTileWidth = 32;
constexpr int kTileHeight = 16;
constexpr int kSupportMargin = 4;  // reach of the support window
constexpr int kLargestPriorSlope = 65535 / (15 * 15);

/// Two planes of 8-bit gradients around 128 with a margin on every side, see GradientImage.
struct GradientView {
  const std::uint8_t* du;  // at pixel (0, 0)
  const std::uint8_t* dv;
  int stride;  // bytes between rows
};

/// One row of support costs. For every u in [0, width): cost_left[u] the least cost over all
/// disparities, disparity_left[u] where; the same for the right picture's pixels.
struct SupportRow {
  std::uint16_t* volume;  // disparity_count x stride
  std::uint16_t* sums;    // scratch: width + 2 kSupportMargin
  std::uint16_t* cost_left;
  std::uint16_t* disparity_left;
  std::uint16_t* cost_right;
  std::uint16_t* disparity_right;
  int stride;
};

/// One tile of the dense matcher, in the reference picture.
struct DenseTile {
  int u0, v0;     // its first pixel
  int direction;  // -1: the other pixel is at u - d (reference = left), +1: at u + d
  int width_px;   // of the pictures
  const std::uint16_t* disparities;  // candidates, ascending
  const std::uint8_t* everywhere;    // per candidate: 1 = for all pixels, 0 = in the band only
  int candidate_count;
  const std::int16_t* prior_px8;  // kTileHeight x kTileWidth, in 1/8 px
  int band_px8;                   // half width of the band
  int prior_slope;                // cost of (1 px)², at most kLargestPriorSlope
  int prior_cap;                  // cost of leaving the plane altogether
  std::uint16_t* best_disparity;  // kTileHeight x kTileWidth
  std::uint16_t* best_cost;       // 0xFFFF where no candidate was allowed
};

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

struct StereoKernels {
  const char* instruction_set;
  /// Sobel of `rows` rows beginning at `image` (border replicated by the caller), as bytes.
  void (*sobelRow)(const std::uint8_t* above, const std::uint8_t* middle, const std::uint8_t* below,
                   int width, int gain_q8, std::uint8_t* du, std::uint8_t* dv);
  void (*supportRow)(const GradientView& left, const GradientView& right, int v, int width,
                     int disparity_min, int disparity_count, const SupportRow& out);
  void (*denseTile)(const GradientView& reference, const GradientView& other,
                    const DenseTile& tile);
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

/// The fastest set that this processor runs.
const StereoKernels& stereoKernels();

/// Every set that this processor runs, slowest first.
struct StereoKernelList {
  const StereoKernels* sets[4];
  int count;
};
StereoKernelList allStereoKernels();

}  // namespace softscope
