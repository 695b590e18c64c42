#include "stereo/plane_prior.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "stereo/delaunay.h"

namespace softscope {
namespace {

const SupportPoint& nearestTo(const std::vector<SupportPoint>& points, int u, int v) {
  const auto distance = [&](const SupportPoint& p) {
    const long du = p.u_px - u, dv = p.v_px - v;
    return du * du + dv * dv;
  };
  return *std::min_element(
      points.begin(), points.end(),
      [&](const SupportPoint& a, const SupportPoint& b) { return distance(a) < distance(b); });
}

/// Anchors along the border, so that triangles cover the whole picture.
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

/// One point a pixel: of several the nearer surface (larger disparity) stays.
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

/// Fills the pixels of one triangle; every pixel inside or on its edges.
void fillTriangle(const std::array<const SupportPoint*, 3>& corner, Raster<std::int16_t>& prior) {
  const auto& [a, b, c] = corner;
  const double bu = b->u_px - a->u_px, bv = b->v_px - a->v_px;
  const double cu = c->u_px - a->u_px, cv = c->v_px - a->v_px;
  const double area = bu * cv - bv * cu;
  if (area == 0) return;
  const double db = b->disparity_px - a->disparity_px, dc = c->disparity_px - a->disparity_px;
  const double slope_u = (db * cv - dc * bv) / area, slope_v = (dc * bu - db * cu) / area;
  const int top = std::min({a->v_px, b->v_px, c->v_px});
  const int bottom = std::max({a->v_px, b->v_px, c->v_px});
  for (int v = std::max(top, 0); v <= std::min(bottom, prior.height_px - 1); ++v) {
    double first = 1e9, last = -1e9;
    for (int k = 0; k < 3; ++k) {
      const SupportPoint *p = corner[k], *q = corner[(k + 1) % 3];
      if ((v < p->v_px && v < q->v_px) || (v > p->v_px && v > q->v_px)) continue;
      const double along =
          p->v_px == q->v_px ? 0.0 : static_cast<double>(v - p->v_px) / (q->v_px - p->v_px);
      const double crossing = p->u_px + along * (q->u_px - p->u_px);
      first = std::min({first, crossing, p->v_px == q->v_px ? q->u_px : crossing});
      last = std::max({last, crossing, p->v_px == q->v_px ? q->u_px : crossing});
    }
    const int begin = std::max(0, static_cast<int>(std::ceil(first - 1e-9)));
    const int end = std::min(prior.width_px - 1, static_cast<int>(std::floor(last + 1e-9)));
    for (int u = begin; u <= end; ++u) {
      const double d = a->disparity_px + slope_u * (u - a->u_px) + slope_v * (v - a->v_px);
      prior.at(u, v) = static_cast<std::int16_t>(std::lround(8 * d));
    }
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
  // In order: a pixel on a shared edge takes the later triangle, whatever the number of threads.
  for (const auto& [i, j, k] : delaunay(positions))
    fillTriangle({&points[i], &points[j], &points[k]}, prior);
  return prior;
}

}  // namespace softscope
