#include "stereo/matching/row_prior.h"

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr float kNone = -1;

/// The rows of the image with support points, top to bottom: one row of both rasters each.
struct PriorRows {
  std::vector<int> v_px;
  Raster<float> disparity_px;
  Raster<float> beside_px;  // columns to the points that the disparity is interpolated from
  Raster<float> away_px;    // rows to them

  int count() const { return static_cast<int>(v_px.size()); }
  float rowsBetween(int i, int j) const {
    return static_cast<float>(
        std::abs(v_px[static_cast<std::size_t>(i)] - v_px[static_cast<std::size_t>(j)]));
  }
};

/// The largest disparity per pixel of those rows, otherwise kNone; distances 0.
PriorRows collectRows(const std::vector<SupportPoint>& points, int width_px, int height_px) {
  const auto is_inside = [&](const SupportPoint& p) {
    return p.u_px >= 0 && p.u_px < width_px && p.v_px >= 0 && p.v_px < height_px;
  };
  std::vector<char> has_points(static_cast<std::size_t>(height_px), 0);
  for (const SupportPoint& p : points)
    if (is_inside(p)) has_points[static_cast<std::size_t>(p.v_px)] = 1;
  PriorRows rows;
  std::vector<int> line_of(static_cast<std::size_t>(height_px));
  for (int v = 0; v < height_px; ++v) {
    line_of[static_cast<std::size_t>(v)] = rows.count();
    if (has_points[static_cast<std::size_t>(v)] != 0) rows.v_px.push_back(v);
  }
  rows.disparity_px = Raster<float>(width_px, rows.count(), kNone);
  rows.beside_px = Raster<float>(width_px, rows.count(), 0);
  rows.away_px = Raster<float>(width_px, rows.count(), 0);
  for (const SupportPoint& p : points) {
    if (!is_inside(p)) continue;
    float& d = rows.disparity_px.at(p.u_px, line_of[static_cast<std::size_t>(p.v_px)]);
    d = std::max(d, p.disparity_px);
  }
  return rows;
}

/// Fills the columns between two points, or from a point to the border if one of them is the
/// column of kNone: `last` = -1 or `next` = width. The distance is the harmonic mean of both.
void fillBetween(int last, int next, int width_px, float* disparity_px, float* beside_px) {
  const bool has_last = last >= 0, has_next = next < width_px;
  const float from = disparity_px[has_last ? last : next];
  const float slope =
      has_last && has_next ? (disparity_px[next] - from) / static_cast<float>(next - last) : 0.0f;
  for (int u = last + 1; u < next; ++u) {
    const float before = static_cast<float>(u - last), after = static_cast<float>(next - u);
    disparity_px[u] = from + slope * before;
    beside_px[u] = !has_last   ? 2 * after
                   : !has_next ? 2 * before
                               : 2 * before * after / (before + after);
  }
}

void interpolateRow(int width_px, float* disparity_px, float* beside_px) {
  int last = -1;
  for (int u = 0; u < width_px; ++u) {
    if (disparity_px[u] == kNone) continue;
    fillBetween(last, u, width_px, disparity_px, beside_px);
    last = u;
  }
  fillBetween(last, width_px, width_px, disparity_px, beside_px);
}

/// In these columns row i takes the value of row `before` if its points are nearer.
void takeNearer(int i, int before, int begin, int end, PriorRows& rows) {
  const float step = rows.rowsBetween(i, before);
  const float *from_d = rows.disparity_px.row(before), *from_beside = rows.beside_px.row(before);
  const float* from_away = rows.away_px.row(before);
  float *d = rows.disparity_px.row(i), *beside = rows.beside_px.row(i), *away = rows.away_px.row(i);
  for (int u = begin; u < end; ++u) {
    const bool nearer = from_beside[u] + from_away[u] + step < beside[u];
    d[u] = nearer ? from_d[u] : d[u];
    beside[u] = nearer ? from_beside[u] : beside[u];
    away[u] = nearer ? from_away[u] + step : 0;
  }
}

/// Interpolates row v of the image, linearly across rows if
/// the points above and below are equally far to the side.
void interpolateBetween(const PriorRows& above, const PriorRows& below, int v,
                        std::int16_t* prior) {
  const int count = above.count();
  const int next = static_cast<int>(std::upper_bound(above.v_px.begin(), above.v_px.end(), v) -
                                    above.v_px.begin());
  const int i = std::max(next - 1, 0), j = std::min(next, count - 1);
  const float rows_above = static_cast<float>(v - above.v_px[static_cast<std::size_t>(i)]);
  const float rows_below = static_cast<float>(below.v_px[static_cast<std::size_t>(j)] - v);
  for (int u = 0; u < above.disparity_px.width_px; ++u) {
    const float d_above = above.disparity_px.at(u, i), d_below = below.disparity_px.at(u, j);
    const float beside_above = above.beside_px.at(u, i), beside_below = below.beside_px.at(u, j);
    const float beside_both = std::min(beside_above, beside_below);
    const float to_above = rows_above + above.away_px.at(u, i) + beside_above - beside_both;
    const float to_below = rows_below + below.away_px.at(u, j) + beside_below - beside_both;
    float d = (d_above * to_below + d_below * to_above) / (to_above + to_below);
    if (next == 0) d = d_below;  // no row above
    if (next == count) d = d_above;
    prior[u] = static_cast<std::int16_t>(static_cast<int>(8 * d + 0.5f));
  }
}

}  // namespace

Raster<std::int16_t> interpolateRows(const std::vector<SupportPoint>& points, int width_px,
                                     int height_px) {
  Raster<std::int16_t> prior(width_px, height_px, kNoPrior);
  PriorRows above = collectRows(points, width_px, height_px);
  const int count = above.count();
  if (count == 0) return prior;
  parallelRows(count, [&](int i) {
    interpolateRow(width_px, above.disparity_px.row(i), above.beside_px.row(i));
  });
  PriorRows below = above;
  parallelRanges(width_px, 64, [&](int begin, int end) {
    for (int i = 1; i < count; ++i) takeNearer(i, i - 1, begin, end, above);
    for (int i = count - 2; i >= 0; --i) takeNearer(i, i + 1, begin, end, below);
  });
  parallelRows(height_px, [&](int v) { interpolateBetween(above, below, v, prior.row(v)); });
  return prior;
}

}  // namespace softscope
