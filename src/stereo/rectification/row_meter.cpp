#include "stereo/rectification/row_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/parallel.h"
#include "stereo/images/view_masks.h"
#include "stereo/matching/support_points.h"
#include "stereo/rectification/row_resampling.h"

namespace softscope {
namespace {

constexpr int kRowPointsPerTask = 64;
// Grid of the pixels that are matched: finer in small images, which would have too few matches.
constexpr int kGridColumns = 53;
constexpr int kFinestGridPx = 4, kCoarsestGridPx = 12;
constexpr int kMeterReach = 4;        // of the window, every second pixel
constexpr int kRowReach = 2;          // rows tried around a support point's
constexpr int kCoarseOffset = 2;      // rows between the coarse trials
constexpr int kFarthestOffset = 10;   // of the trials
constexpr double kManyMore = 1.5;     // matches one row off, where texture is weak
constexpr std::size_t kMany = 150;    // matches sufficient to determine the rows
constexpr std::size_t kPlenty = 300;  // of a sparser grid: sufficient to see that rows correspond
constexpr double kInReachPx = 0.35;   // mean difference: half of one spread evenly over the reach
constexpr double kLeastCurvature = 0.3;    // of the cost over rows; below, rows are not determined
constexpr double kLeastShareAcross = 0.2;  // of the vertical texture; below, it is an edge's

/// Mean difference of the two windows.
double windowCost(const GradientView& left, const GradientView& right, int u, int v, int u_right,
                  int v_right) {
  int sum = 0;
  for (int dy = -kMeterReach; dy <= kMeterReach; dy += 2)
    for (int dx = -kMeterReach; dx <= kMeterReach; dx += 2) {
      const int a = *left.at(u + dx, v + dy), b = *right.at(u_right + dx, v_right + dy);
      sum += std::abs(a % 256 - b % 256) + std::abs(a / 256 - b / 256);
    }
  return sum / 50.0;
}

/// Share of the window's vertical texture that a shift along the row does not explain: 1 - ρ², with
/// the correlation ρ of horizontal and vertical gradients. A straight edge has 0: it looks alike in
/// every row, at another disparity (the aperture problem).
double shareAcross(const GradientView& left, int u, int v) {
  double xx = 0, xy = 0, yy = 0;
  for (int dy = -kMeterReach; dy <= kMeterReach; dy += 2)
    for (int dx = -kMeterReach; dx <= kMeterReach; dx += 2) {
      const int packed = *left.at(u + dx, v + dy);
      const int x = packed % 256 - 128, y = packed / 256 - 128;
      xx += x * x;
      xy += x * y;
      yy += y * y;
    }
  return xx > 0 && yy > 0 ? 1 - xy * xy / (xx * yy) : 0;
}

/// The row of the best match of the window of a support point, to a fraction of a pixel.
std::optional<RowMatch> matchRow(const GradientView& left, const GradientView& right,
                                 const SupportPoint& point, int row_offset) {
  if (shareAcross(left, point.u_px, point.v_px) < kLeastShareAcross) return {};
  const int disparity = static_cast<int>(std::lround(point.disparity_px));
  std::array<double, 2 * kRowReach + 1> cost;
  cost.fill(1e9);
  for (int k = -kRowReach; k <= kRowReach; ++k)
    for (int shift = -1; shift <= 1; ++shift)
      cost[k + kRowReach] =
          std::min(cost[k + kRowReach],
                   windowCost(left, right, point.u_px, point.v_px, point.u_px - disparity + shift,
                              point.v_px + row_offset + k));
  const auto best = std::min_element(cost.begin(), cost.end());
  if (best == cost.begin() || best == cost.end() - 1) return {};
  const double curvature = best[-1] - 2 * best[0] + best[1];
  if (curvature < kLeastCurvature) return {};
  const double row = row_offset + static_cast<double>(best - cost.begin()) - kRowReach +
                     0.5 * (best[-1] - best[1]) / curvature;
  return RowMatch{static_cast<double>(point.u_px - disparity), point.v_px + row, row, point.u_px,
                  point.v_px};
}

/// With many matches near the row that was tried, farther rows are not needed: what difference they
/// have is measured by these.
bool isInReach(const std::vector<RowMatch>& matches, int row_offset) {
  if (matches.size() < kMany) return false;
  double sum_px = 0;
  for (const RowMatch& m : matches) sum_px += std::abs(m.difference_px - row_offset);
  return sum_px < kInReachPx * static_cast<double>(matches.size());
}

/// Noise moves single matches out of reach, but not the model that they agree on.
bool hasModelInReach(const std::vector<RowMatch>& matches, const RowAlignment& scale) {
  if (matches.size() < kMany) return false;
  const RowAlignment model = fitRowModel(matches, scale);
  double model_sum_px = 0, rest_sum_px = 0;
  for (const RowMatch& m : matches) {
    const double model_px = model.at(m.u_right_px, m.v_right_px);
    model_sum_px += std::abs(model_px);
    rest_sum_px += std::abs(m.difference_px - model_px);
  }
  return std::max(model_sum_px, rest_sum_px) < kInReachPx * static_cast<double>(matches.size());
}

/// The row that is tried first.
int firstOffset(const RowPlane& expected) {
  return static_cast<int>(std::lround(expected.centre_px));
}

}  // namespace

RowMeter::RowMeter(const GrayImage& left, int disparity_max_px, const Mask& ignored)
    : margin_px_(disparity_max_px),
      left_(fillMasked(left, ignored), ElasOptions{}.gradient_gain, disparity_max_px, ignored) {
  options_.disparity_max_px = disparity_max_px;
  grid_px_ = std::clamp(left_.width_px() / kGridColumns, kFinestGridPx, kCoarsestGridPx);
}

RowAlignment RowMeter::scale() const {
  RowAlignment scale;
  scale.half_width_px = left_.width_px() / 2.0;
  scale.centre_u_px = (left_.width_px() - 1) / 2.0;
  scale.centre_v_px = (left_.height_px() - 1) / 2.0;
  return scale;
}

GradientImage RowMeter::gradientOf(const GrayImage& right, const Mask& ignored) const {
  return {fillMasked(right, ignored), ElasOptions{}.gradient_gain, margin_px_, ignored};
}

/// Whether rows of one offset do not reach those at the image's sides.
bool RowMeter::isSteep(const RowPlane& expected) const {
  const double half_height_px = left_.height_px() / 2.0, half_width_px = left_.width_px() / 2.0;
  return std::abs(expected.per_column) * half_width_px +
             std::abs(expected.per_row) * half_height_px >
         kRowReach + kCoarseOffset;
}

RowAlignment RowMeter::measure(const GrayImage& right, const Mask& ignored,
                               const RowPlane& expected) {
  if (isSteep(expected)) return fitRowModel(match(right, ignored, expected), scale(), expected);
  const GradientImage gradient = gradientOf(right, ignored);
  const int first = firstOffset(expected);
  const auto few = matchRows(gradient, first, grid_px_ + grid_px_ / 2);
  const bool is_enough = few.size() >= kPlenty && isInReach(few, first);
  return fitRowModel(is_enough ? few : matchNearest(gradient, expected), scale(), expected);
}

std::vector<RowMatch> RowMeter::match(const GrayImage& right, const Mask& ignored,
                                      const RowPlane& expected) {
  if (!expected.isKnown()) return matchNearest(gradientOf(right, ignored));
  const RowAlignment moved = withModel(expected, scale());
  auto matches = matchNearest(gradientOf(moveRows(right, moved), moveMaskRows(ignored, moved)));
  for (RowMatch& m : matches) {
    const double moved_px = moved.at(m.u_right_px, m.v_right_px);
    m.difference_px += moved_px;
    m.v_right_px += moved_px;
  }
  return matches;
}

std::vector<RowMatch> RowMeter::matchNearest(const GradientImage& right, const RowPlane& expected) {
  const int first = firstOffset(expected);
  const auto matches = matchRows(right, first, grid_px_);
  if (isInReach(matches, first)) return matches;
  std::map<int, std::vector<RowMatch>> found{{first, matches}};
  const auto matchesAt = [&](int offset) -> const std::vector<RowMatch>& {
    const auto [place, is_new] = found.try_emplace(offset);
    if (is_new) place->second = matchRows(right, offset, grid_px_);
    return place->second;
  };
  // The true rows give the most matches, except those that a roll moves further.
  int best = first;
  const auto compare = [&](int offset, double least_gain) {
    const auto count = static_cast<double>(matchesAt(offset).size());
    if (count > least_gain * static_cast<double>(matchesAt(best).size())) best = offset;
  };
  const auto search = [&] {
    for (int offset = kCoarseOffset; offset <= kFarthestOffset; offset += kCoarseOffset) {
      compare(-offset, 1);
      compare(offset, 1);
      if (offset >= std::abs(best) + 2 * kCoarseOffset && matchesAt(best).size() >= kMany) break;
    }
    // Weak texture has matches in its own row alone, which may be one between the trials.
    for (const int between : {best - 1, best + 1}) compare(between, kManyMore);
  };
  if (!expected.isKnown() && !hasModelInReach(matches, scale())) search();
  std::vector<RowMatch> nearest = matchesAt(best);
  for (const int neighbour : {best - kCoarseOffset, best + kCoarseOffset}) {
    const std::vector<RowMatch>& more = matchesAt(neighbour);
    nearest.insert(nearest.end(), more.begin(), more.end());
  }
  return nearest;
}

std::vector<RowMatch> RowMeter::matchRows(const GradientImage& right, int row_offset, int grid_px) {
  options_.elas.support_step_px = grid_px;
  const auto points = findSupportPoints(left_, right, options_, row_offset);
  const int top = kMeterReach + kRowReach, bottom = left_.height_px() - top;
  std::vector<std::optional<RowMatch>> found(points.size());
  parallelRanges(static_cast<int>(points.size()), kRowPointsPerTask, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      if (points[i].v_px + row_offset >= top && points[i].v_px + row_offset < bottom)
        found[i] = matchRow(left_.view(), right.view(), points[i], row_offset);
  });
  std::vector<RowMatch> matches;
  std::vector<float> disparities_px;
  for (std::size_t i = 0; i < points.size(); ++i) {
    disparities_px.push_back(points[i].disparity_px);
    if (found[i]) matches.push_back(*found[i]);
  }
  // The next images have the same range; wrong rows have no range.
  if (disparities_px.size() >= kMany) options_ = narrowedTo(disparities_px, options_);
  return matches;
}

}  // namespace softscope
