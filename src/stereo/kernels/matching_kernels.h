// src/stereo/kernels/matching_kernels.h: the inner loops of matching: gradients, support costs,
// tiles.
//
// Compiled once for each instruction set (stereo_kernels.h). Raw pointers only: a header-only
// container compiled with AVX2 could be picked by the linker for the whole program. Floating point
// is never contracted, so that every set gives the same bytes.
#pragma once

#include <cstdint>

namespace softscope {

/// Tile of the dense matcher; also the cell that shares support disparities.
constexpr int kTileWidth = 32;
constexpr int kTileHeight = 16;
constexpr int kSupportMargin = 4;     // reach of the support window
constexpr int kDenseWindowReach = 2;  // of the dense matcher
constexpr int kSobelReach = 1;
constexpr int kSupportScratch = 64;    // margins and the rest of a register
constexpr int kSupportNarrowest = 32;  // columns common to the images at a disparity
constexpr int kLargestPriorSlope = 65535 / (15 * 15);

/// Both 8-bit gradients of a pixel, around 128, packed: du +
/// 256 dv. With a margin on every side, see GradientImage.
struct GradientView {
  const std::uint16_t* packed;  // at pixel (0, 0)
  int stride;                   // pixels between rows

  const std::uint16_t* at(int u, int v) const { return packed + static_cast<long>(v) * stride + u; }
};

/// One row of support costs. For every u in [0, width): cost_left[u] the minimum cost
/// over all disparities, disparity_left[u] its disparity; the same for the pixels of
/// the right image; 0xFFFF and 0 if the window is inside both images at none.
struct SupportRow {
  std::uint16_t* volume;  // disparity_count x stride; from column d + kSupportMargin on
  std::uint16_t* sums;    // scratch: width + kSupportScratch
  std::uint16_t* cost_left;
  std::uint16_t* disparity_left;
  std::uint16_t* cost_right;
  std::uint16_t* disparity_right;
  int stride;
};

/// One tile of the dense matcher, in the reference image.
struct DenseTile {
  int u0, v0;     // its first pixel
  int direction;  // -1: the other pixel is at u - d (reference = left), +1: at u + d
  int width_px;   // of the images
  const std::uint16_t* disparities;  // candidates, ascending
  const std::uint8_t* everywhere;    // per candidate: 1 = for all pixels, 0 = in the band only
  int candidate_count;
  const std::int16_t* prior_px8;  // kTileHeight x kTileWidth, in 1/8 px
  int band_px8;                   // half width of the band
  int prior_slope;                // cost of (1 px)², at most kLargestPriorSlope
  int prior_cap;                  // cost of a disparity far from the plane
  std::uint16_t* best_disparity;  // kTileHeight x kTileWidth
  std::uint16_t* best_cost;       // 0xFFFF if no candidate was allowed
};

struct MatchingKernels {
  /// Sobel responses of the middle one of three rows, readable from -1 to width.
  void (*sobelRow)(const std::uint8_t* above, const std::uint8_t* middle, const std::uint8_t* below,
                   int width, int gain_q8, std::uint16_t* packed);
  void (*supportRow)(const GradientView& left, const GradientView& right, int v, int width,
                     int disparity_min, int disparity_count, const SupportRow& out);
  void (*denseTile)(const GradientView& reference, const GradientView& other,
                    const DenseTile& tile);
};

}  // namespace softscope
