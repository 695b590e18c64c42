#include "stereo/matching/plane_prior.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "stereo/matching/delaunay.h"

namespace softscope {
namespace {

constexpr int kRowsPerTask = 64;

const SupportPoint& nearestTo(const std::vector<SupportPoint>& points, int u, int v) {
  const auto distance = [&](const SupportPoint& p) {
    const long du = p.u_px - u, dv = p.v_px - v;
    return du * du + dv * dv;
  };
  return *std::min_element(
      points.begin(), points.end(),
      [&](const SupportPoint& a, const SupportPoint& b) { return distance(a) < distance(b); });
}

/// Anchors along the border, so that triangles cover the whole image.
void addBorder(std::vector<SupportPoint>& points, int width, int height) {
  constexpr int kAnchorStep = 64;
  std::vector<SupportPoint> anchors;
  const auto add = [&](int u, int v) {
    anchors.push_back({u, v, nearestTo(points, u, v).disparity_px});
  };
  for (int u = 0; u < width - 1; u += kAnchorStep) {
    add(u, 0);
    add(u, height - 1);
  }
  for (int v = kAnchorStep; v < height - 1; v += kAnchorStep) {
    add(0, v);
    add(width - 1, v);
  }
  add(width - 1, 0);
  add(width - 1, height - 1);
  points.insert(points.end(), anchors.begin(), anchors.end());
}

/// One point per pixel: the nearest surface (largest disparity) is kept.
void makeDistinct(std::vector<SupportPoint>& points) {
  std::sort(points.begin(), points.end(), [](const SupportPoint& a, const SupportPoint& b) {
    if (a.v_px != b.v_px) return a.v_px < b.v_px;
    if (a.u_px != b.u_px) return a.u_px < b.u_px;
    return a.disparity_px > b.disparity_px;
  });
  points.erase(std::unique(points.begin(), points.end(),
                           [](const SupportPoint& a, const SupportPoint& b) {
                             return a.v_px == b.v_px && a.u_px == b.u_px;
                           }),
               points.end());
}

/// Columns of a triangle in a row.
struct Span {
  double first = 1e9, last = -1e9;
  void widen(double u) {
    first = std::min(first, u);
    last = std::max(last, u);
  }
};

/// One side of a triangle, from its upper to its lower end.
class Side {
 public:
  Side(const SupportPoint* p, const SupportPoint* q)
      : upper_(p->v_px <= q->v_px ? p : q), lower_(p->v_px <= q->v_px ? q : p) {
    const int rows = lower_->v_px - upper_->v_px;
    slope_ = rows == 0 ? 0 : static_cast<double>(lower_->u_px - upper_->u_px) / rows;
  }
  void widen(int v, Span& span) const {
    if (v < upper_->v_px || v > lower_->v_px) return;
    span.widen(upper_->u_px + slope_ * (v - upper_->v_px));
    if (upper_->v_px == lower_->v_px) span.widen(lower_->u_px);
  }

 private:
  const SupportPoint *upper_, *lower_;
  double slope_;
};

/// Rows from `begin` to `end`, exclusive.
struct RowBand {
  int begin, end;
};

/// Fills the pixels of one triangle in some rows; all pixels inside or on its edges.
void fillTriangle(const SupportPoint& a, const SupportPoint& b, const SupportPoint& c,
                  const RowBand& band, Raster<std::int16_t>& prior) {
  const int top = std::max(std::min({a.v_px, b.v_px, c.v_px}), band.begin);
  const int bottom = std::min(std::max({a.v_px, b.v_px, c.v_px}), band.end - 1);
  if (top > bottom) return;
  const double bu = b.u_px - a.u_px, bv = b.v_px - a.v_px;
  const double cu = c.u_px - a.u_px, cv = c.v_px - a.v_px;
  const double area = bu * cv - bv * cu;
  if (area == 0) return;
  const double db = b.disparity_px - a.disparity_px, dc = c.disparity_px - a.disparity_px;
  const double slope_u = 8 * (db * cv - dc * bv) / area, slope_v = 8 * (dc * bu - db * cu) / area;
  const Side sides[] = {{&a, &b}, {&b, &c}, {&c, &a}};
  for (int v = top; v <= bottom; ++v) {
    Span span;
    for (const Side& side : sides) side.widen(v, span);
    // Both ends are at least -1: truncation is the floor of what is not negative.
    const int begin = std::max(0, static_cast<int>(span.first + 1 - 1e-9));
    const int end = std::min(prior.width_px - 1, static_cast<int>(span.last + 1e-9));
    // In 1/8 px; rounded, and disparities are not negative.
    const double at_zero = 8.0 * a.disparity_px + slope_v * (v - a.v_px) - slope_u * a.u_px + 0.5;
    std::int16_t* row = prior.row(v);
    for (int u = begin; u <= end; ++u)
      row[u] = static_cast<std::int16_t>(static_cast<int>(at_zero + slope_u * u));
  }
}

}  // namespace

Raster<std::int16_t> interpolatePlanes(std::vector<SupportPoint> points, int width_px,
                                       int height_px) {
  Raster<std::int16_t> prior(width_px, height_px, kNoPrior);
  if (points.empty()) return prior;
  addBorder(points, width_px, height_px);
  makeDistinct(points);
  std::vector<Eigen::Vector2i> positions;
  for (const SupportPoint& p : points) positions.emplace_back(p.u_px, p.v_px);
  // In order: a pixel on a shared edge gets the later triangle, for any number of threads.
  const std::vector<std::array<int, 3>> triangles = delaunay(positions);
  parallelRanges(height_px, kRowsPerTask, [&](int begin, int end) {
    for (const auto& [i, j, k] : triangles)
      fillTriangle(points[static_cast<std::size_t>(i)], points[static_cast<std::size_t>(j)],
                   points[static_cast<std::size_t>(k)], {begin, end}, prior);
  });
  return prior;
}

}  // namespace softscope
