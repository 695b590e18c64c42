#include "pipeline/material_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/not_measured.h"
#include "core/parallel.h"
#include "deform/graph/warp.h"
#include "fusion/cell_table.h"
#include "pipeline/nearest_depth.h"

namespace softscope {
namespace {

constexpr double kSurfaceMm = 0.7;    // radius of the surface piece of a point
constexpr double kMaxSettleMm = 0.5;  // of near tissue; a larger distance is another surface

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

/// Depth of the surface at the pixel: from its 5 x 5 neighbours; in a gap
/// or next to an instrument, from measured pixels around it, extrapolated
/// from the nearest one at 45 degrees at most. NaN without any.
double depthAround(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel, double focal_px) {
  const double here_mm = planeAround(depth_mm, pixel, 2, 13);
  if (std::isfinite(here_mm)) return here_mm;
  const int gap_px = gapPx(depth_mm.width_px);
  const double around_mm = planeAround(depth_mm, pixel, gap_px, gap_px * gap_px);
  if (!std::isfinite(around_mm)) return nearestDepth(depth_mm, pixel, kSmallGapPx).depth_mm;
  const NearestDepth nearest = nearestDepth(depth_mm, pixel, gap_px);
  const double limit_mm = nearest.slackMm(focal_px);
  return std::clamp(around_mm, nearest.depth_mm - limit_mm, nearest.depth_mm + limit_mm);
}

/// Without std::floor(), which is a call into the C library where SSE4.1 is not taken for granted.
std::int64_t floorOf(double x) {
  const std::int64_t whole = static_cast<std::int64_t>(x);
  return whole - (static_cast<double>(whole) > x ? 1 : 0);
}

std::int64_t cellOf(const Eigen::Vector3d& position_mm) {
  constexpr std::int64_t kBias = 1 << 20;
  return (floorOf(position_mm.x() / kSurfaceMm) + kBias) << 42 |
         (floorOf(position_mm.y() / kSurfaceMm) + kBias) << 21 |
         (floorOf(position_mm.z() / kSurfaceMm) + kBias);
}

/// Tracked points in and next to each cell.
class TrackedNear {
 public:
  explicit TrackedNear(std::size_t expected) : table_(expected) {
    keys_.reserve(expected);
    points_.reserve(expected);
    next_.reserve(expected);
  }
  void add(std::int64_t cell, int point) {
    const std::int32_t entry = static_cast<std::int32_t>(keys_.size());
    keys_.push_back(static_cast<CellKey>(cell));
    points_.push_back(point);
    std::int32_t& first = firstOf(keys_.back());
    next_.push_back(first);
    first = entry;
  }
  bool empty() const { return keys_.empty(); }
  /// Calls found(point) for each tracked point in or next to the cell.
  template <class Found>
  void forEach(std::int64_t cell, const Found& found) const {
    for (std::int32_t entry = firstOf(static_cast<CellKey>(cell)); entry != CellHashTable::kEmpty;
         entry = next_[static_cast<std::size_t>(entry)])
      found(points_[static_cast<std::size_t>(entry)]);
  }

 private:
  /// The last entry of the cell; the others follow from it.
  std::int32_t& firstOf(CellKey key) const {
    return table_.find(key, [&](std::int32_t entry) { return keys_[entry] == key; });
  }

  mutable CellHashTable table_;
  std::vector<CellKey> keys_;  // per entry, like the others
  std::vector<int> points_;
  std::vector<std::int32_t> next_;
};

/// The model around one tracked point.
struct SurfacePiece {
  double weight = 0, height_mm = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Contribution of one model point to the piece of a tracked point.
struct SurfaceShare {
  int point;
  double weight, height_mm;
  Eigen::Vector3d normal;
};

/// Of all model points, in their order.
std::vector<SurfaceShare> surfaceShares(const TrackedNear& near, const PointModel& model,
                                        const std::vector<MaterialPoints::Point>& points) {
  std::vector<SurfaceShare> all;
  if (near.empty()) return all;
  const auto sharesOf = [&](std::size_t i, std::vector<SurfaceShare>* shares) {
    const Eigen::Vector3d position = model.positions_mm[i].cast<double>();
    near.forEach(cellOf(position), [&](int k) {
      const Eigen::Vector3d away = position - points[static_cast<std::size_t>(k)].position_mm;
      const double share = 1 - away.squaredNorm() / (kSurfaceMm * kSurfaceMm);
      if (share <= 0) return;
      const Eigen::Vector3d normal = model.normals[i].cast<double>();
      const double weight = share * model.weights[i];
      shares->push_back({k, weight, weight * normal.dot(away), weight * normal});
    });
  };
  const std::size_t grain = kPointsPerTask, tasks = (model.size() + grain - 1) / grain;
  std::vector<std::vector<SurfaceShare>> parts(tasks);
  parallelRanges(static_cast<int>(tasks), 1, [&](int begin, int end) {
    for (std::size_t task = static_cast<std::size_t>(begin); task < static_cast<std::size_t>(end);
         ++task)
      for (std::size_t i = task * grain; i < std::min(model.size(), (task + 1) * grain); ++i)
        sharesOf(i, &parts[task]);
  });
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::int32_t nearestPoint(const PointModel& model, const Eigen::Vector3f& position_mm) {
  std::int32_t nearest = -1;
  float best = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < model.size(); ++i) {
    const float distance = (model.positions_mm[i] - position_mm).squaredNorm();
    if (distance < best) {
      best = distance;
      nearest = static_cast<std::int32_t>(i);
    }
  }
  return nearest;
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

void MaterialPoints::anchor(const PointModel& model) {
  constexpr int kSearchesPerTask = 4;  // each visits the whole model
  parallelRanges(static_cast<int>(points.size()), kSearchesPerTask, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      Point& point = points[static_cast<std::size_t>(k)];
      if (point.model_point < 0 && point.position_mm.allFinite())
        point.model_point = nearestPoint(model, point.position_mm.cast<float>());
    }
  });
}

void MaterialPoints::warp(const WarpGraph& graph, const PointModel& model) {
  for (Point& point : points) {
    if (point.model_point < 0) continue;
    const PointBinding& binding = model.bindings[static_cast<std::size_t>(point.model_point)];
    const Eigen::Vector3d before = point.position_mm;
    point.position_mm = warpPoint(graph, binding, before);
    for (int k = 0; k < 2; ++k)
      point.pixels_mm.col(k) =
          (warpPoint(graph, binding, before + FirstLook::kHalfPx * point.pixels_mm.col(k)) -
           point.position_mm) /
          FirstLook::kHalfPx;
  }
}

void MaterialPoints::renumber(const IndexMap& map, const PointModel& model) {
  std::vector<Point*> removed;
  for (Point& point : points) {
    if (point.model_point < 0) continue;
    point.model_point = map.new_of_old[static_cast<std::size_t>(point.model_point)];
    if (point.model_point == IndexMap::kRemoved) removed.push_back(&point);
  }
  constexpr int kSearchesPerTask = 1;  // each visits the whole model
  parallelRanges(static_cast<int>(removed.size()), kSearchesPerTask, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      Point& point = *removed[static_cast<std::size_t>(k)];
      point.model_point = nearestPoint(model, point.position_mm.cast<float>());
    }
  });
}

void MaterialPoints::settle(const PointModel& model, const Eigen::Vector3d& scope_mm,
                            double limit_scale) {
  const double limit_mm = kMaxSettleMm * limit_scale;
  constexpr int kCellsAround = 27;
  TrackedNear near(points.size() * kCellsAround);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].model_point < 0) continue;
    for (int cell = 0; cell < kCellsAround; ++cell) {
      const Eigen::Vector3d step(cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1);
      near.add(cellOf(points[k].position_mm + kSurfaceMm * step), static_cast<int>(k));
    }
  }
  std::vector<SurfacePiece> pieces(points.size());
  for (const SurfaceShare& share : surfaceShares(near, model, points)) {
    SurfacePiece& piece = pieces[static_cast<std::size_t>(share.point)];
    piece.weight += share.weight;
    piece.height_mm += share.height_mm;
    piece.normal += share.normal;
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (pieces[k].weight <= 0 || pieces[k].normal.norm() <= 0) continue;
    const double height = pieces[k].height_mm / pieces[k].weight;
    if (!(std::abs(height) < limit_mm)) continue;
    const Eigen::Vector3d normal = pieces[k].normal.normalized();
    const Eigen::Vector3d ray = (points[k].position_mm - scope_mm).normalized();
    const double cosine = normal.dot(ray);
    const double along_ray_mm = height / cosine;
    // At a grazing angle, the ray meets the surface far away.
    points[k].position_mm += std::abs(along_ray_mm) < limit_mm ? Eigen::Vector3d(along_ray_mm * ray)
                                                               : Eigen::Vector3d(height * normal);
  }
}

}  // namespace softscope
