#include "stereo/matching/support_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/parallel.h"
#include "core/raster.h"
#include "stereo/kernels/matching_formulas.h"
#include "stereo/kernels/stereo_kernels.h"

namespace softscope {
namespace {

constexpr float kNoCandidate = kNoSupport;
constexpr int kMarginPx = kSupportMargin;

/// Mean |gradient| of the support window around (u, v).
double texture(const GradientView& image, int u, int v) {
  return static_cast<double>(supportTextureSum(image.at(u, v), image.stride)) / kCostDifferences;
}

/// Minimum cost at u over disparities that are not next to `best`.
int secondBestCost(const SupportRow& row, int u, int best, int count) {
  int second = 0xFFFF;
  for (int i = 0; i < count; ++i)
    if (std::abs(i - best) > 1)
      second = std::min<int>(second, row.volume[static_cast<long>(i) * row.stride + u]);
  return second;
}

/// Pixels whose windows reach a masked one, in both views; empty without a mask.
struct BlockedPixels {
  Mask left, right;
};

/// The support candidates of one row, kNoCandidate after a failed test.
class RowMatcher {
 public:
  RowMatcher(const GradientImage& left, const GradientImage& right, const BlockedPixels& blocked,
             const StereoOptions& options, int row_offset_px)
      : left_(left.view()),
        right_(right.view(row_offset_px)),
        blocked_(blocked),
        row_offset_(row_offset_px),
        width_(left.width_px()),
        minimum_(options.disparity_min_px),
        count_(options.disparity_max_px - options.disparity_min_px + 1),
        elas_(options.elas) {
    const std::size_t stride = static_cast<std::size_t>((width_ + 63) / 64 * 64);
    buffer_.resize(stride * (static_cast<std::size_t>(count_) + 5) + kSupportScratch);
    std::uint16_t* rest = buffer_.data() + stride * static_cast<std::size_t>(count_);
    row_ = {buffer_.data(),    rest + 4 * stride,       rest, rest + stride, rest + 2 * stride,
            rest + 3 * stride, static_cast<int>(stride)};
  }

  void match(int v, float* candidates, int columns) {
    matchingKernels().supportRow(left_, right_, v, width_, minimum_, count_, row_);
    for (int c = 0; c < columns; ++c) candidates[c] = candidate(c * elas_.support_step_px, v);
  }

 private:
  float candidate(int u, int v) const {
    if (u < kMarginPx || u >= width_ - kMarginPx || row_.cost_left[u] == 0xFFFF)
      return kNoCandidate;
    const int disparity = row_.disparity_left[u], best = disparity - minimum_;
    if (texture(left_, u, v) < elas_.support_texture) return kNoCandidate;
    if (isBlocked(blocked_.left, u, v)) return kNoCandidate;
    if (isBlocked(blocked_.right, u - disparity, v + row_offset_)) return kNoCandidate;
    const int returned = row_.disparity_right[u - disparity];
    if (std::abs(returned - disparity) > elas_.support_left_right_px) return kNoCandidate;
    if (best == 0 || best == count_ - 1)
      return kNoCandidate;  // the true one may be outside of the range
    const int count = supportCountAt(u, width_, minimum_, count_);
    if (row_.cost_left[u] > elas_.support_uniqueness * secondBestCost(row_, u, best, count))
      return kNoCandidate;
    if (best + 1 == count) return static_cast<float>(disparity);
    return static_cast<float>(disparity) +
           parabolaOffset(cost(best - 1, u), cost(best, u), cost(best + 1, u));
  }
  static bool isBlocked(const Mask& blocked, int u, int v) {
    return blocked.contains(u, v) && blocked.at(u, v) != 0;
  }
  int cost(int i, int u) const { return row_.volume[static_cast<long>(i) * row_.stride + u]; }

  GradientView left_, right_;
  const BlockedPixels& blocked_;
  int row_offset_;
  int width_, minimum_, count_;
  const ElasOptions& elas_;
  std::vector<std::uint16_t> buffer_;
  SupportRow row_;
};

bool hasNeighbours(const Raster<float>& grid, int c, int r, const ElasOptions& options) {
  const int reach = options.support_window_cells;
  int neighbours = -1;  // without the point itself
  for (int y = std::max(0, r - reach); y <= std::min(grid.height_px - 1, r + reach); ++y)
    for (int x = std::max(0, c - reach); x <= std::min(grid.width_px - 1, c + reach); ++x)
      neighbours +=
          grid.at(x, y) != kNoCandidate && std::abs(grid.at(x, y) - grid.at(c, r)) <=
                                               static_cast<float>(options.support_agreement_px);
  return neighbours >= options.support_min_neighbours;
}

Raster<float> removeLonely(const Raster<float>& grid, const ElasOptions& options) {
  Raster<float> kept(grid.width_px, grid.height_px, kNoCandidate);
  parallelRows(grid.height_px, [&](int r) {
    for (int c = 0; c < grid.width_px; ++c)
      if (grid.at(c, r) != kNoCandidate && hasNeighbours(grid, c, r, options))
        kept.at(c, r) = grid.at(c, r);
  });
  return kept;
}

void matchRows(const GradientImage& left, const GradientImage& right, const BlockedPixels& blocked,
               const StereoOptions& options, int row_offset_px, const std::vector<int>& rows,
               Raster<float>& grid) {
  parallelRanges(static_cast<int>(rows.size()), 4, [&](int begin, int end) {
    RowMatcher matcher(left, right, blocked, options, row_offset_px);
    for (int i = begin; i < end; ++i) {
      const int r = rows[static_cast<std::size_t>(i)];
      matcher.match(r * options.elas.support_step_px, grid.row(r), grid.width_px);
    }
  });
}

std::vector<float> foundIn(const Raster<float>& grid) {
  std::vector<float> found;
  std::copy_if(grid.values.begin(), grid.values.end(), std::back_inserter(found),
               [](float d) { return d != kNoCandidate; });
  return found;
}

}  // namespace

StereoOptions narrowedTo(const std::vector<float>& disparities_px, StereoOptions options) {
  if (disparities_px.size() < std::size_t{kFewestForRange}) return options;
  const int first = options.disparity_min_px, last = options.disparity_max_px;
  // Number of disparities within kNearDisparityPx of
  // each, those of first - kNearDisparityPx first.
  std::vector<int> alike(static_cast<std::size_t>(last - first + 1 + 2 * kNearDisparityPx));
  for (const float d : disparities_px) {
    const long shifted = std::clamp<long>(std::lround(d), first, last) - first;
    for (long i = shifted; i <= shifted + 2 * kNearDisparityPx; ++i)
      ++alike[static_cast<std::size_t>(i)];
  }
  const auto isSurface = [](int count) { return count >= kFewestNear; };
  const auto low = std::find_if(alike.begin(), alike.end(), isSurface);
  const auto high = std::find_if(alike.rbegin(), alike.rend(), isSurface);
  if (low == alike.end()) return options;
  const int lowest = first - kNearDisparityPx + static_cast<int>(low - alike.begin());
  const int highest = first - kNearDisparityPx + static_cast<int>(alike.rend() - high) - 1;
  options.disparity_min_px = std::max(first, lowest - kBeyondRangePx);
  options.disparity_max_px = std::min(last, highest + kBeyondRangePx);
  return options;
}

std::vector<SupportPoint> findSupportPoints(const GradientImage& left, const GradientImage& right,
                                            const StereoOptions& options, int row_offset_px) {
  const int step = options.elas.support_step_px;
  Raster<float> grid((left.width_px() + step - 1) / step, (left.height_px() + step - 1) / step,
                     kNoCandidate);
  std::vector<int> first_rows, other_rows;
  for (int r = 0; r < grid.height_px; ++r)
    if (r * step >= kMarginPx && r * step < left.height_px() - kMarginPx)
      (r % kRangeRows == 1 ? first_rows : other_rows).push_back(r);
  BlockedPixels blocked;
  parallelInvoke([&] { blocked.left = left.blocked(kMarginPx); },
                 [&] { blocked.right = right.blocked(kMarginPx); });
  matchRows(left, right, blocked, options, row_offset_px, first_rows, grid);
  matchRows(left, right, blocked, narrowedTo(foundIn(grid), options), row_offset_px, other_rows,
            grid);
  grid = removeLonely(grid, options.elas);
  std::vector<SupportPoint> points;
  for (int r = 0; r < grid.height_px; ++r)
    for (int c = 0; c < grid.width_px; ++c)
      if (grid.at(c, r) != kNoCandidate) points.push_back({c * step, r * step, grid.at(c, r)});
  return points;
}

std::vector<SupportPoint> supportFromRight(std::vector<SupportPoint> points) {
  for (SupportPoint& p : points) p.u_px -= static_cast<int>(p.disparity_px + 0.5f);
  return points;
}

}  // namespace softscope
