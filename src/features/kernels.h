// src/features/kernels.h: the inner loops of the model view and of matching, compiled once for
// each instruction set.
//
// Raw pointers only: a header-only container compiled here with AVX2 could be picked by the linker
// for the whole program. Floating point is never contracted, so that every set gives the same
// bytes.
#pragma once

#include <cstdint>

#include "core/kernel_list.h"
#include "features/window_kernels.h"

namespace softscope {

/// A model point as a small disc of the image. Its plane makes the inverse depth linear in the
/// pixel.
struct SplatDisc {
  float u_px, v_px, radius_px;
  float inverse_depth;     // 1/mm, at the centre
  float slope_u, slope_v;  // of the inverse depth, 1/mm per pixel
  float red, green, blue, anchor;
  std::int32_t point;
};

/// Rows first_row … first_row + rows - 1 of the image that is being drawn. Pointers stand at
/// column 0 of the first row; kSplatMargin columns beyond either end may be written.
constexpr int kSplatMargin = 48;
constexpr int kLargestDiscPx = 3;
struct SplatBand {
  float* front;  // largest inverse depth seen so far, 0 = nothing
  float* weight;
  float* red;
  float* green;
  float* blue;
  float* anchor;
  float* inverse_depth;  // weighted sum, like the colours
  float* shift_u;        // weighted sum of the pixel minus the disc's centre
  float* shift_v;
  float* best_weight;
  std::int32_t* point;  // of the disc with the best weight
  int stride;
  int first_row;
  int rows;
  float tolerance_mm;  // what lies this far behind the front still belongs to it
};

/// Descriptors of length 1 become bytes: 128 + kDescriptorUnit * value, clamped.
constexpr int kDescriptorSize = 64;
constexpr float kDescriptorUnit = 300;

/// Nodes of a grid of descriptors that one descriptor is compared with.
struct DescriptorWindow {
  const std::uint8_t* others;  // the first node's descriptor
  const std::uint8_t* valid;   // the first node's; 0 = not compared
  int grid_columns;            // from one row of nodes to the next
  int columns, rows;
};
/// Distances of a window by rows of `stride` values, a multiple of kDistanceLanes; kNoDistance
/// where a node is not valid and beyond the last column.
constexpr int kDistanceLanes = 16;
constexpr int kNoDistance = 0xFFFF;
struct WindowDistances {
  std::uint16_t* values;
  int stride;
};
/// The first of the least distances, by rows.
struct NearestNode {
  int distance, column, row;
};

struct ConsistencyRules;
/// Places of matches: on the model and in the live image, px.
struct MatchPlaces {
  const float *model_u, *model_v, *live_u, *live_v;
};
/// How many matches are neighbours of one, and how many of those moved alike.
struct NeighbourCounts {
  int others, agreeing;
};

struct FeatureKernels {
  const char* instruction_set;
  /// Nearest surface of every pixel.
  void (*splatFront)(const SplatDisc* discs, int count, const SplatBand& band);
  /// Colours and depth of the discs on that surface, weighted by distance from their centres.
  void (*splatBlend)(const SplatDisc* discs, int count, const SplatBand& band);
  /// Haar wavelets of size 2 h from an integral image, right minus left and lower minus upper half,
  /// of one row of pixels; 0, and valid = 0, where an invalid pixel takes part. integral(u, v) sums
  /// the pixels above and left of (u, v), exclusive; pointers stand at the rows `-h` (top), 0
  /// (middle) and `+h` (bottom), at the first pixel's column.
  void (*haarRow)(const std::int32_t* top, const std::int32_t* middle, const std::int32_t* bottom,
                  const std::int32_t* invalid_top, const std::int32_t* invalid_bottom, int h,
                  int count, std::int32_t* du, std::int32_t* dv, std::int32_t* valid);
  /// One descriptor from 4 x 4 cells of four sums each: cell (i, j) begins at rows[i][j * step].
  /// Bytes around 128, in 1 / kDescriptorUnit of the length. Returns the length.
  float (*describe)(const float* const* rows, int step, std::uint8_t* bytes);
  /// Sums of absolute differences between one descriptor of 64 bytes and `count` that follow each
  /// other.
  void (*descriptorDistances)(const std::uint8_t* one, const std::uint8_t* others, int count,
                              std::uint16_t* distances);
  /// All distances of a window, and the least of them. At least one row and column.
  NearestNode (*searchWindow)(const std::uint8_t* one, const DescriptorWindow& window,
                              const WindowDistances& distances);
  /// Least distance of nodes more than `reach` columns or rows away from `node`.
  int (*secondBestDistance)(const WindowDistances& distances, int rows, const NearestNode& node,
                            int reach);
  /// Of match `own` among the `count` first of `places`; itself counts too where it is one of them.
  NeighbourCounts (*countNeighbours)(const MatchPlaces& places, int count, const MatchPlaces& own,
                                     const ConsistencyRules& rules);
  const WindowKernels* windows;
};

/// The fastest set that this processor runs.
const FeatureKernels& featureKernels();

/// Every set that this processor runs, slowest first.
KernelList<FeatureKernels> allFeatureKernels();

}  // namespace softscope
