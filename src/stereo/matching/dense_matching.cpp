#include "stereo/matching/dense_matching.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "core/parallel.h"
#include "stereo/kernels/matching_formulas.h"
#include "stereo/kernels/stereo_kernels.h"
#include "stereo/matching/row_prior.h"

namespace softscope {
namespace {

constexpr int kMaxDisparities = StereoOptions::kLargestDisparityPx + 1;
using DisparitySet = std::bitset<kMaxDisparities>;

/// No disparity if the window reaches a masked pixel.
void dropBlocked(const GradientImage& reference, Raster<std::int16_t>& disparity) {
  const Mask blocked = reference.blocked(kDenseWindowReach);
  for (std::size_t i = 0; i < blocked.size(); ++i)
    if (blocked.values[i] != 0) disparity.values[i] = -1;
}

/// The disparities of the support points in and around each tile.
class SharedDisparities {
 public:
  SharedDisparities(const std::vector<SupportPoint>& points, int columns, int rows)
      : cells_(columns, rows) {
    for (const SupportPoint& p : points) {
      const int c = p.u_px / kTileWidth, r = p.v_px / kTileHeight;
      if (cells_.contains(c, r))
        cells_.at(c, r).set(static_cast<std::size_t>(std::lround(p.disparity_px)));
    }
  }
  /// Of the tile and its eight neighbours, each widened by one pixel.
  DisparitySet around(int c, int r) const {
    DisparitySet all;
    for (int y = std::max(0, r - 1); y <= std::min(cells_.height_px - 1, r + 1); ++y)
      for (int x = std::max(0, c - 1); x <= std::min(cells_.width_px - 1, c + 1); ++x)
        all |= cells_.at(x, y);
    return all | all << 1 | all >> 1;
  }

 private:
  Raster<DisparitySet> cells_;
};

/// Buffers of one tile, and how to fill them.
class TileMatcher {
 public:
  TileMatcher(const GradientView& reference, const GradientView& other, int direction,
              const Raster<std::int16_t>& prior, const StereoOptions& options)
      : reference_(reference), other_(other), prior_(prior), options_(options) {
    const PriorCost cost = priorCostOf(options.elas);
    tile_.direction = direction;
    tile_.width_px = prior.width_px;
    tile_.band_px8 = cost.band_px8;
    tile_.prior_slope = cost.slope;
    tile_.prior_cap = cost.cap;
  }

  void match(int u0, int v0, DisparitySet shared, Raster<std::int16_t>& disparity) {
    tile_.u0 = u0;
    tile_.v0 = v0;
    loadPrior();
    listCandidates(shared);
    tile_.disparities = candidates_.data();
    tile_.everywhere = everywhere_.data();
    tile_.candidate_count = static_cast<int>(candidates_.size());
    tile_.prior_px8 = prior_px8_;
    tile_.best_disparity = best_disparity_;
    tile_.best_cost = best_cost_;
    matchingKernels().denseTile(reference_, other_, tile_);
    store(disparity);
  }

 private:
  /// Outside of the image its last row and column are repeated.
  void loadPrior() {
    const int inside = std::min(kTileWidth, prior_.width_px - tile_.u0);
    for (int y = 0; y < kTileHeight; ++y) {
      const std::int16_t* from =
          prior_.row(std::min(tile_.v0 + y, prior_.height_px - 1)) + tile_.u0;
      std::int16_t* to = prior_px8_ + y * kTileWidth;
      std::copy_n(from, inside, to);
      std::fill(to + inside, to + kTileWidth, from[inside - 1]);
    }
  }

  void listCandidates(const DisparitySet& shared) {
    // Rows are smooth: the band around the extremes covers the band of every pixel.
    int low = prior_px8_[0], high = low;
    for (const std::int16_t prior : prior_px8_) {
      low = std::min<int>(low, prior);
      high = std::max<int>(high, prior);
    }
    const DisparityBand band =
        bandAround(low, high, tile_.band_px8, options_.disparity_min_px, options_.disparity_max_px);
    candidates_.clear();
    everywhere_.clear();
    for (int d = options_.disparity_min_px; d <= options_.disparity_max_px; ++d) {
      const bool is_shared = shared[static_cast<std::size_t>(d)];
      if (!is_shared && (d < band.first || d > band.last)) continue;
      candidates_.push_back(static_cast<std::uint16_t>(d));
      everywhere_.push_back(is_shared);
    }
  }

  void store(Raster<std::int16_t>& disparity) const {
    const int width = std::min(kTileWidth, disparity.width_px - tile_.u0);
    const int height = std::min(kTileHeight, disparity.height_px - tile_.v0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int i = y * kTileWidth + x;
        disparity.at(tile_.u0 + x, tile_.v0 + y) =
            best_cost_[i] == 0xFFFF ? std::int16_t{-1}
                                    : static_cast<std::int16_t>(best_disparity_[i]);
      }
  }

  GradientView reference_, other_;
  const Raster<std::int16_t>& prior_;
  const StereoOptions& options_;
  DenseTile tile_{};
  std::vector<std::uint16_t> candidates_;
  std::vector<std::uint8_t> everywhere_;
  alignas(64) std::int16_t prior_px8_[kTileWidth * kTileHeight];
  alignas(64) std::uint16_t best_disparity_[kTileWidth * kTileHeight];
  alignas(64) std::uint16_t best_cost_[kTileWidth * kTileHeight];
};

}  // namespace

Raster<std::int16_t> matchDense(const GradientImage& left, const GradientImage& right,
                                Reference reference, const std::vector<SupportPoint>& points,
                                const StereoOptions& options) {
  const int width = left.width_px(), height = left.height_px();
  Raster<std::int16_t> disparity(width, height, -1);
  if (points.empty()) return disparity;
  const Raster<std::int16_t> prior = interpolateRows(points, width, height);
  const int columns = (width + kTileWidth - 1) / kTileWidth;
  const int rows = (height + kTileHeight - 1) / kTileHeight;
  const SharedDisparities shared(points, columns, rows);
  const bool from_left = reference == Reference::kLeft;
  parallelRanges(rows, 2, [&](int begin, int end) {
    TileMatcher matcher(from_left ? left.view() : right.view(),
                        from_left ? right.view() : left.view(), from_left ? -1 : 1, prior, options);
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < columns; ++c)
        matcher.match(c * kTileWidth, r * kTileHeight, shared.around(c, r), disparity);
  });
  dropBlocked(from_left ? left : right, disparity);
  return disparity;
}

}  // namespace softscope
