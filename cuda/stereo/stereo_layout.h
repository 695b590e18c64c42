// cuda/stereo/stereo_layout.h: arrays of the stereo stage, planned from settings and image
// size.
#pragma once

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "cuda/device/arena.h"
#include "cuda/stereo/stereo_dense.h"
#include "cuda/stereo/stereo_filter.h"
#include "cuda/stereo/stereo_fringes.h"
#include "cuda/stereo/stereo_ignored.h"
#include "cuda/stereo/stereo_mixed.h"
#include "cuda/stereo/stereo_prior.h"
#include "cuda/stereo/stereo_refinement.h"
#include "cuda/stereo/stereo_relief.h"
#include "cuda/stereo/stereo_support.h"
#include "cuda/stereo/stereo_surface.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/options/stereo_options.h"
#include "stereo/refinement/pyramid.h"

namespace softscope::cuda {

/// Data with the same initial value in every frame, contiguous for one kernel.
struct LevelCounters {
  DisparityRange narrowed;
  int point_count, mixed_count;
  LightDifference light;
  OpenShare share;
};

/// One level of the pyramid.
struct StereoLevel {
  StereoLevel(Arena& arena, const StereoOptions& level_options, int width_px, int height_px)
      : options(level_options), width(width_px), height(height_px), grid(supportGrid()) {
    for (int view = 0; view < 2; ++view) planView(arena, view);
    planSupport(arena);
    planBits(arena);
    planResults(arena);
  }

  std::size_t bitWords() const {
    return static_cast<std::size_t>(2 * bits.columns * bits.rows) * TileBits::kWords;
  }

  StereoOptions options;
  int width, height;
  SupportGrid grid;
  View<std::uint8_t> gray[2];
  View<std::uint8_t> ignored[2], ignored_rows[2];  // Ignored; of the first pass, along rows
  GradientPlane gradient[2];
  std::uint8_t* gradient_bytes[2] = {nullptr, nullptr};  // with margins
  int gradient_byte_count = 0;
  SupportCosts costs;
  float *support, *kept;  // on the grid
  PriorRows rows;
  View<std::int16_t> prior[2], whole[2];
  TileBits bits;
  View<float> slow[2], smooth[2];  // of the first pass, along rows; then response, EvidenceCentre
  View<float> fast_part[2], slow_part[2];  // of the brightness
  LightSums* light_parts;
  View<std::uint8_t> dark_rows, marks, near_marks, mixed;
  ResidualPlanes residuals;
  View<float> disparity[2];  // steps write from one to the other
  View<float> planes;        // disparity before relief was returned
  View<float> sigma, response;
  View<ReliefSquare> relief_squares[2];
  View<float> smooth_relief;
  int *islands_labels, *islands_sizes, *mixed_list;
  LevelCounters* counters;
  Selection* selection;

 private:
  SupportGrid supportGrid() const {
    const ElasOptions& elas = options.elas;
    const int step = elas.support_step_px;
    return {width,
            height,
            step,
            (width + step - 1) / step,
            (height + step - 1) / step,
            {options.disparity_min_px, options.disparity_max_px},
            elas.support_texture,
            elas.support_uniqueness,
            elas.support_left_right_px,
            elas.support_window_cells,
            elas.support_agreement_px,
            elas.support_min_neighbours};
  }

  /// The images of one camera.
  void planView(Arena& arena, int view) {
    gray[view] = arena.image<std::uint8_t>(width, height);
    ignored[view] = arena.image<std::uint8_t>(width, height);
    ignored_rows[view] = arena.image<std::uint8_t>(width, height);
    gradient[view] = planGradient(arena);
    prior[view] = arena.image<std::int16_t>(width, height);
    whole[view] = arena.image<std::int16_t>(width, height);
    slow[view] = arena.image<float>(width, height);
    smooth[view] = arena.image<float>(width, height);
    fast_part[view] = arena.image<float>(width, height);
    slow_part[view] = arena.image<float>(width, height);
    disparity[view] = arena.image<float>(width, height);
  }

  /// Support points and the prior between them.
  void planSupport(Arena& arena) {
    const auto grid_rows = static_cast<std::size_t>(grid.rows);
    const std::size_t points = static_cast<std::size_t>(grid.columns) * grid_rows;
    const std::size_t row_pixels = grid_rows * static_cast<std::size_t>(grid.width);
    costs.best_left = arena.array<std::uint32_t>(2 * row_pixels);
    costs.best_right = costs.best_left == nullptr ? nullptr : costs.best_left + row_pixels;
    costs.volume = arena.array<std::uint16_t>(points * static_cast<std::size_t>(grid.count()));
    support = arena.array<float>(points);
    kept = arena.array<float>(points);
    rows.own = arena.array<PriorEvidence>(2 * row_pixels);
    rows.above = arena.array<PriorEvidence>(2 * row_pixels);
    rows.below = arena.array<PriorEvidence>(2 * row_pixels);
    rows.has_points = arena.array<int>(2 * grid_rows);
    rows.width = width;
    rows.rows = grid.rows;
    rows.step = options.elas.support_step_px;
  }

  void planBits(Arena& arena) {
    bits.columns = blocksFor(width, kTileWidth);
    bits.rows = blocksFor(height, kTileHeight);
    bits.words = arena.array<std::uint32_t>(bitWords());
  }

  /// Filters, refinement and their counters.
  void planResults(Arena& arena) {
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    dark_rows = arena.image<std::uint8_t>(width, height);
    marks = arena.image<std::uint8_t>(width, height);
    near_marks = arena.image<std::uint8_t>(width, height);
    mixed = arena.image<std::uint8_t>(width, height);
    planes = arena.image<float>(width, height);
    sigma = arena.image<float>(width, height);
    response = slow[0];
    for (View<ReliefSquare>& squares : relief_squares)
      squares = arena.image<ReliefSquare>(reliefSquares(width), reliefSquares(height));
    smooth_relief = arena.image<float>(reliefSquares(width), reliefSquares(height));
    for (float*& plane : residuals.planes) plane = arena.array<float>(pixels);
    islands_labels = arena.array<int>(pixels);
    islands_sizes = arena.array<int>(pixels);
    mixed_list = arena.array<int>(pixels);
    counters = arena.array<LevelCounters>(1);
    light_parts = arena.array<LightSums>(static_cast<std::size_t>(LightFit::samplesAlong(height)) *
                                         LightFit::kParts);
    selection = arena.array<Selection>(1);
  }

  GradientPlane planGradient(Arena& arena) {
    const int side = GradientPlane::sideMargin(options.disparity_max_px);
    const int stride = (width + 2 * side + 63) / 64 * 64;
    const int count = stride * (height + 2 * GradientPlane::kRowMargin);
    auto* values = arena.array<std::uint16_t>(static_cast<std::size_t>(count));
    const int view = gradient[0].stride == 0 ? 0 : 1;
    gradient_bytes[view] = reinterpret_cast<std::uint8_t*>(values);
    gradient_byte_count = 2 * count;
    GradientPlane plane;
    plane.stride = stride;
    if (values != nullptr) plane.origin = values + GradientPlane::kRowMargin * stride + side;
    return plane;
  }
};

/// All levels, and the results of the stage.
struct StereoLayout {
  StereoLayout(Arena& arena, const StereoOptions& options, int width, int height) {
    StereoOptions level_options = options.forWidth(width);
    for (int k = 0; k <= options.elas.coarser_levels; ++k) {
      levels.emplace_back(arena, level_options, width, height);
      if (std::min(width, height) < 2 * kSmallestPicturePx) break;
      level_options = halved(level_options);
      width /= 2;
      height /= 2;
    }
    const StereoLevel& full = levels.front();
    mask = arena.image<std::uint8_t>(full.width, full.height);
    dropped = arena.image<std::uint8_t>(full.width, full.height);
    if (options.smoothing.reach_blocks > 0) {
      smoothing = smoothingRules(options.smoothing, options.refinement, full.width, full.height);
      const auto blocks =
          static_cast<std::size_t>(smoothing.columns) * static_cast<std::size_t>(smoothing.rows);
      means = arena.array<SmoothingBlock>(blocks);
      patches = arena.array<SmoothingPatch>(blocks);
    }
    smoothed = arena.image<float>(full.width, full.height);
    smoothed_sigma = arena.image<float>(full.width, full.height);
    rims = arena.image<float>(full.width, full.height);
    rim_rows = arena.image<float>(full.width, full.height);
    inputs = arena.array<FrameInputs>(1);
    disparity = arena.image<float>(full.width, full.height);
    sigma = arena.image<float>(full.width, full.height);
    depth = arena.image<float>(full.width, full.height);
    depth_sigma = arena.image<float>(full.width, full.height);
    normals = arena.image<NormalPixel>(full.width, full.height);
  }

  std::vector<StereoLevel> levels;
  View<std::uint8_t> mask, dropped;  // before the normals; after them
  SmoothingRules smoothing{};
  SmoothingBlock* means = nullptr;
  SmoothingPatch* patches = nullptr;
  View<float> smoothed, smoothed_sigma, rims, rim_rows;
  FrameInputs* inputs = nullptr;
  View<float> disparity, sigma, depth, depth_sigma;
  View<NormalPixel> normals;
};

/// Throws OptionError for options without GPU version.
inline void requireDeviceLimits(const StereoOptions& options, int width_px) {
  require(options.method == "elas", "stereo.method", options.method, "only elas runs on the GPU");
  require(width_px <= PriorRowKernel::kWidest, "image width", width_px,
          "the GPU takes at most 8192 pixels");
  require(options.smoothing.reach_blocks <= PatchWindow::kWidestReach,
          "stereo.smoothing.reach_blocks", options.smoothing.reach_blocks,
          "the GPU takes at most 7");
}

}  // namespace softscope::cuda
