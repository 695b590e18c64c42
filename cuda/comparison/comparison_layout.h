// cuda/comparison/comparison_layout.h: every array of the comparison of model and frame, planned
// from sizes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image.h"
#include "core/point_model.h"
#include "core/warp_graph.h"
#include "cuda/device/arena.h"
#include "cuda/device/fixed_sum.h"
#include "cuda/device/rank_search.h"
#include "cuda/model/model_layout.h"
#include "fusion/block_correlation.h"
#include "fusion/colour_gain.h"
#include "fusion/drawn_points.h"
#include "fusion/fusion_options.h"
#include "fusion/sight_formulas.h"

namespace softscope::cuda {

/// Weighted totals of seen points: of one node, or of the frame.
struct InnovationSums {
  FixedSum weight, away_mm, expected_mm2, square_mm2;
};

/// What comes down in one piece; the blocks of the image follow.
struct ComparisonTotals {
  InnovationSums frame;
  FixedSum difference_mm, absolute_mm;  // model minus measurement
  std::uint32_t differences;
  std::int32_t compared_px, agreeing_px;
  RankSearch rank;
  std::int32_t gain[3][kGainBins];
};

/// Arrays of the image's size: the rasters of a frame, and what is drawn.
struct ComparisonFrameLayout {
  ComparisonFrameLayout() = default;
  ComparisonFrameLayout(Arena& arena, int width_px, int height_px)
      : width(width_px),
        height(height_px),
        block_px(BlockCorrelation::blockPx(width_px)),
        block_columns(blocksFor(width_px, block_px)),
        block_rows(blocksFor(height_px, block_px)) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    gain_bins = arena.array<std::int16_t>(256 * 256);
    near_cells = arena.array<std::uint32_t>(cells());
    drawn_cells = arena.array<std::uint32_t>(cells());
    drawn = arena.array<unsigned long long>(pixels);
    differences_mm = arena.array<float>(pixels);
    rank_counts = arena.array<std::uint32_t>(kRankCounts);
    // From here on in one piece:
    const std::size_t begin = arena.bytes();
    totals = arena.array<ComparisonTotals>(1);
    evidence = arena.array<BlockSums>(blocks());
    anchors = arena.array<BlockSums>(blocks());
    totals_bytes = arena.bytes() - begin;
  }

  static constexpr int kCellPx = DrawnPoints::kCellPx;
  static_assert(kCellPx == VisibilityOptions::kOcclusionCellPx, "one size of squares for both");
  std::size_t cells() const {
    return static_cast<std::size_t>(blocksFor(width, kCellPx)) *
           static_cast<std::size_t>(blocksFor(height, kCellPx));
  }
  std::size_t blocks() const { return static_cast<std::size_t>(block_columns * block_rows); }
  SOFTSCOPE_HD int cellOf(int pixel) const {
    const int columns = (width + kCellPx - 1) / kCellPx;
    return pixel / width / kCellPx * columns + pixel % width / kCellPx;
  }
  SOFTSCOPE_HD int blockOf(int pixel) const {
    return pixel / width / block_px * block_columns + pixel % width / block_px;
  }

  int width = 0, height = 0, block_px = 1, block_columns = 0, block_rows = 0;
  bool has_sigma = false, has_colour = false;
  const float *depth_mm = nullptr, *sigma_mm = nullptr;  // they lie elsewhere
  const Eigen::Vector3f* normals = nullptr;
  const PixelState* states = nullptr;
  const Rgb8* colour = nullptr;
  std::int16_t* gain_bins = nullptr;                            // by seen and known level
  std::uint32_t *near_cells = nullptr, *drawn_cells = nullptr;  // bits of depths
  unsigned long long* drawn = nullptr;                          // DrawnPoints::entry()
  float* differences_mm = nullptr;                              // NaN where nothing was compared
  std::uint32_t* rank_counts = nullptr;
  ComparisonTotals* totals = nullptr;
  BlockSums *evidence = nullptr, *anchors = nullptr;  // of the model's image; of the anchors
  std::size_t totals_bytes = 0;
};

/// The model's points, which lie elsewhere, and the comparison of each with the frame.
struct ComparisonModelLayout : ModelArrays {
  ComparisonModelLayout() = default;
  ComparisonModelLayout(Arena& arena, std::size_t points) {
    sights = arena.array<PointSight>(points);
    seen = arena.array<std::uint8_t>(points);
  }

  int count = 0;
  PointSight* sights = nullptr;
  std::uint8_t* seen = nullptr;
};

/// The nodes that carry the points.
struct ComparisonGraphLayout {
  ComparisonGraphLayout() = default;
  ComparisonGraphLayout(Arena& arena, std::size_t node_count, std::size_t sets)
      : nodes(static_cast<int>(node_count)), stencil_count(static_cast<int>(sets)) {
    stencils = arena.array<NodeStencil>(sets);
    sums = arena.array<InnovationSums>(node_count);
    away_mm = arena.array<double>(node_count);
  }

  int nodes = 0, stencil_count = 0;
  NodeStencil* stencils = nullptr;
  InnovationSums* sums = nullptr;
  double* away_mm = nullptr;  // mean absolute difference around each node
};

}  // namespace softscope::cuda
