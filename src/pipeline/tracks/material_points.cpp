#include "pipeline/tracks/material_points.h"

#include <algorithm>
#include <cmath>

#include "core/not_measured.h"
#include "core/tolerance.h"
#include "deform/graph/warp.h"
#include "features/nearest_depth.h"
#include "fusion/surface_search.h"

namespace softscope {
namespace {

constexpr std::int64_t kFewestMeasurements = 2;  // in frames; the first one may be a mismatch
constexpr double kMaxSettleMm = 0.5;    // of near tissue; a larger distance is another surface
constexpr double kSettleShare = 0.3;    // of the distance to the surface, covered in a frame
constexpr double kReachSpacings = 2;    // of nodes around the points that they carry
constexpr double kGrazingCosine = 0.2;  // between normal and ray: below, the ray meets it far away

/// Depth at the pixel by a plane fitted to the inverse depth of the
/// measured pixels within `radius_px`. NaN with fewer than `least` of them.
double planeAround(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel, int radius_px,
                   int least) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int count = 0;
  visitMeasured(depth_mm, pixel, radius_px, [&](double x, double y, float depth) {
    const Eigen::Vector3d row(1, x, y);
    normal += row * row.transpose();
    right += row / depth;
    ++count;
  });
  if (count < least) return kNotMeasured<double>;
  return 1 / normal.ldlt().solve(right).x();
}

constexpr int kLeastMeasured = 13;  // pixels: fewer may be a mismatch

bool isAmongMeasured(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel) {
  return measuredAround(depth_mm, pixel, kSmallGapPx) >= kLeastMeasured;
}

/// Depth of the surface at the pixel: from its 5 x 5 neighbours; in a gap
/// or next to an instrument, from measured pixels around it, extrapolated
/// from the nearest one at 45 degrees at most. NaN without any, or with a few only.
double depthAround(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel, double focal_px) {
  const double here_mm = planeAround(depth_mm, pixel, kOwnRadiusPx, kOwnLeast);
  if (std::isfinite(here_mm)) return here_mm;
  const int gap_px = gapPx(depth_mm.width_px);
  const double around_mm = planeAround(depth_mm, pixel, gap_px, gap_px * gap_px);
  if (!std::isfinite(around_mm))
    return isAmongMeasured(depth_mm, pixel) ? nearestDepth(depth_mm, pixel, kSmallGapPx).depth_mm
                                            : kNotMeasured<double>;
  const NearestDepth nearest = nearestDepth(depth_mm, pixel, gap_px);
  const double limit_mm = nearest.slackMm(focal_px);
  return std::clamp(around_mm, nearest.depth_mm - limit_mm, nearest.depth_mm + limit_mm);
}

/// Weighted mean of the nodes of a bound point.
Eigen::Vector3d middleOfNodes(const WarpGraph& graph, const PointBinding& binding) {
  const NodeStencil& stencil = graph.stencils[binding.stencil];
  Eigen::Vector3d sum_mm = Eigen::Vector3d::Zero();
  double total = 0;
  for (int k = 0; k < kNodesPerPoint; ++k) {
    if (!(binding.weights[k] > 0)) continue;
    sum_mm += static_cast<double>(binding.weights[k]) * graph.positions_mm[stencil[k]];
    total += binding.weights[k];
  }
  return sum_mm / total;
}

void bindToNearest(const std::vector<MaterialPoints::Point*>& points, const PointModel& model,
                   SurfaceSearch* search) {
  if (points.empty()) return;
  std::vector<Eigen::Vector3f> positions_mm;
  for (const MaterialPoints::Point* point : points)
    positions_mm.push_back(point->position_mm.cast<float>());
  const std::vector<std::int32_t> nearest = search->nearestPoints(model, positions_mm);
  for (std::size_t k = 0; k < points.size(); ++k) points[k]->model_point = nearest[k];
}

}  // namespace

void MaterialPoints::add(int id, const Eigen::Vector2d& pixel, const PinholeCamera& left,
                         const Raster<float>& depth_mm, const Eigen::Isometry3d& world_from_left) {
  Point point;
  point.id = id;
  const double depth = depthAround(depth_mm, pixel, left.fx_px);
  if (std::isfinite(depth))
    point.position_mm = world_from_left * liftPixel(left, pixel.x(), pixel.y(), depth);
  points.push_back(point);
}

void MaterialPoints::anchor(const PointModel& model, SurfaceSearch* search) {
  std::vector<Point*> unbound;
  for (Point& point : points)
    if (point.model_point < 0 && point.position_mm.allFinite()) unbound.push_back(&point);
  bindToNearest(unbound, model, search);
}

void MaterialPoints::warp(const WarpGraph& graph, const PointModel& model, double node_spacing_mm) {
  for (Point& point : points) {
    if (point.model_point < 0) continue;
    const PointBinding& binding = model.bindings[static_cast<std::size_t>(point.model_point)];
    if (!binding.bound()) continue;
    const Eigen::Vector3d before = point.position_mm, middle_mm = middleOfNodes(graph, binding);
    if ((before - middle_mm).norm() > kReachSpacings * node_spacing_mm) {
      // The rotations of nodes so far away would throw it about.
      point.position_mm += warpPoint(graph, binding, middle_mm) - middle_mm;
      continue;
    }
    point.position_mm = warpPoint(graph, binding, before);
    for (int k = 0; k < 2; ++k)
      point.pixels_mm.col(k) =
          (warpPoint(graph, binding, before + FirstLook::kHalfPx * point.pixels_mm.col(k)) -
           point.position_mm) /
          FirstLook::kHalfPx;
  }
}

void MaterialPoints::renumber(const IndexMap& map, const PointModel& model, double node_spacing_mm,
                              SurfaceSearch* search) {
  std::vector<Point*> unbound;
  for (Point& point : points) {
    if (point.model_point < 0) continue;
    point.model_point = map.new_of_old[static_cast<std::size_t>(point.model_point)];
    if (point.model_point == IndexMap::kRemoved ||
        (model.positions_mm[static_cast<std::size_t>(point.model_point)].cast<double>() -
         point.position_mm)
                .norm() > node_spacing_mm)
      unbound.push_back(&point);
  }
  bindToNearest(unbound, model, search);
}

void MaterialPoints::settle(const PointModel& model, const Eigen::Vector3d& scope_mm,
                            double limit_scale, SurfaceSearch* search) {
  const double limit_mm = kMaxSettleMm * limit_scale;
  std::vector<Point*> bound;
  std::vector<Eigen::Vector3d> positions_mm;
  for (Point& point : points) {
    if (point.model_point < 0) continue;
    bound.push_back(&point);
    positions_mm.push_back(point.position_mm);
  }
  if (bound.empty()) return;
  const std::vector<SurfacePiece> pieces = search->piecesAround(model, positions_mm);
  for (std::size_t k = 0; k < bound.size(); ++k) {
    Eigen::Vector3d& position_mm = bound[k]->position_mm;
    if (pieces[k].weight <= 0 || pieces[k].normal.norm() <= 0) continue;
    const double height = pieces[k].height_mm / pieces[k].weight;
    if (!(std::abs(height) < limit_mm)) continue;
    const Eigen::Vector3d normal = pieces[k].normal.normalized();
    const Eigen::Vector3d ray = (position_mm - scope_mm).normalized();
    const double cosine = normal.dot(ray);
    const bool grazes =
        std::abs(cosine) < kGrazingCosine || !(std::abs(height / cosine) < limit_mm);
    position_mm += kSettleShare * height * (grazes ? normal : Eigen::Vector3d(ray / cosine));
  }
}

void MaterialPoints::countMeasured(const std::vector<TrackedPosition>& positions) {
  ++fused_frames;
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k].measured_frames += positions[k].measured ? 1 : 0;
}

void MaterialPoints::hideUnmeasured(std::vector<TrackedPosition>* positions) const {
  const std::int64_t fewest = std::min(kFewestMeasurements, fused_frames);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (points[k].measured_frames < fewest) (*positions)[k] = {points[k].id};
}

double preciseShare(const std::vector<TrackedPosition>& positions) {
  int visible = 0, precise = 0;
  for (const TrackedPosition& point : positions) {
    visible += point.visible;
    precise += point.visible && point.sigma_mm <= kPreciseSigmaMm;
  }
  return visible > 0 ? double(precise) / visible : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace softscope
