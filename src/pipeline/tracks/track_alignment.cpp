// src/pipeline/tracks/track_alignment.cpp: tracked points moved to the positions of their first
// looks.
#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "features/nearest_depth.h"
#include "pipeline/tracks/material_points.h"

namespace softscope {
namespace {

constexpr int kLooksPerTask = 2;

/// Measurement of one tracked point in an image.
struct SeenLook {
  bool in_sight = false, found = false;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  // measured
  double variance_mm2 = 0;                                // predicted, per direction
  double off_mm2 = 0;  // squared distance from the expected position, along the surface
};

/// First looks in one image, of points of the left camera frame.
struct FirstLookSearch {
  const PinholeCamera& left;
  const Eigen::Isometry3d& world_from_left;

  /// Pixels of the image per pixel of the look, right and down.
  Eigen::Matrix2d imageFromLook(const MaterialPoints::Point& point,
                                const Eigen::Vector3d& centre) const {
    Eigen::Matrix2d map;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d edge =
          world_from_left.linear().transpose() * point.pixels_mm.col(k) * FirstLook::kHalfPx;
      const Eigen::Vector3d ahead = centre + edge, behind = centre - edge;
      map.col(k) =
          (projectPoint(left, ahead) - projectPoint(left, behind)) / (2 * FirstLook::kHalfPx);
    }
    return map;
  }
  /// `centre`: expected position; `number`: of the point.
  SoughtLook sought(const MaterialPoints::Point& point, std::size_t number,
                    const Eigen::Vector3d& centre) const {
    return {&point.look, static_cast<std::int32_t>(number), projectPoint(left, centre),
            imageFromLook(point, centre)};
  }
  /// What was found, on the plane of the point's pixels.
  void tell(const MaterialPoints::Point& point, const SoughtLook& expected, const FoundLook& found,
            SeenLook* seen) const {
    if (!found.found) return;
    const Eigen::Vector3d centre = world_from_left.inverse() * point.position_mm;
    const Eigen::Vector3d normal =
        world_from_left.linear().transpose() * point.pixels_mm.col(0).cross(point.pixels_mm.col(1));
    const Eigen::Vector3d ray = liftPixel(left, found.pixel.x(), found.pixel.y(), 1.0);
    const Eigen::Vector3d place = ray * (normal.dot(centre) / normal.dot(ray));
    const double pixel_mm = centre.z() / left.fx_px;
    const double off_mm = (found.pixel - expected.pixel).norm() * pixel_mm;
    if (!((place - centre).norm() <= kSteepest * off_mm)) return;
    seen->found = true;
    seen->position_mm = world_from_left * place;
    seen->variance_mm2 = found.sigma_px * found.sigma_px * pixel_mm * pixel_mm;
    seen->off_mm2 = off_mm * off_mm;
  }
};

/// Variance per direction added by the last warp: that of the measured moves,
/// less the variances of looks and points. NaN with fewer than kLeastLooks.
double driftOf(const std::vector<MaterialPoints::Point>& points,
               const std::vector<SeenLook>& seen) {
  constexpr std::size_t kLeastLooks = 8;
  constexpr double kMedianOfTwo = 1.386;  // of the sum of two squared normal deviates
  std::vector<double> off, expected;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!seen[k].found || !std::isfinite(points[k].variance_mm2)) continue;
    off.push_back(seen[k].off_mm2 / kMedianOfTwo);
    expected.push_back(points[k].variance_mm2 + seen[k].variance_mm2);
  }
  if (off.size() < kLeastLooks) return kNotMeasured<double>;
  return std::max(0.0, medianOf(std::move(off)) - medianOf(std::move(expected)));
}

/// Move of a point by its measured look, and its previous position.
struct FoundMove {
  Eigen::Vector3d position_mm;
  Eigen::Vector3d move_mm;
};

/// Kalman gain: docs/fusion.md (F29).
FoundMove moveTowards(const SeenLook& seen, MaterialPoints::Point* point) {
  double& variance_mm2 = point->variance_mm2;
  const bool known = std::isfinite(variance_mm2);
  const double gain = known ? variance_mm2 / (variance_mm2 + seen.variance_mm2) : 1.0;
  const FoundMove found{point->position_mm, gain * (seen.position_mm - point->position_mm)};
  point->position_mm += found.move_mm;
  // Errors of a look are correlated between frames: repeated looks do not reduce them.
  variance_mm2 = known ? std::min(variance_mm2, seen.variance_mm2) : seen.variance_mm2;
  return found;
}

/// The error of the warp is similar nearby: mean of the moves, with weights
/// that decrease by e per `reach_mm` of distance, and zero without a near one.
Eigen::Vector3d moveOfNeighbours(const std::vector<FoundMove>& found,
                                 const Eigen::Vector3d& position_mm, double reach_mm) {
  constexpr double kFarthest = 6;  // of the reach; a share of 1/400
  double shares = 0;
  Eigen::Vector3d move_mm = Eigen::Vector3d::Zero();
  for (const FoundMove& near : found) {
    const double distance_sq = (near.position_mm - position_mm).squaredNorm();
    if (distance_sq > kFarthest * kFarthest * reach_mm * reach_mm) continue;
    const double share = std::exp(-std::sqrt(distance_sq) / reach_mm);
    shares += share;
    move_mm += share * near.move_mm;
  }
  return move_mm / std::max(shares, 1.0);
}

}  // namespace

void MaterialPoints::look(const LookPicture& picture, const PointModel& model,
                          const PinholeCamera& left, const Eigen::Isometry3d& world_from_left,
                          const DepthMap& depth) {
  const Eigen::Isometry3d left_from_world = world_from_left.inverse();
  const auto lookAt = [&](Point& point) {
    if (point.model_point < 0) return;
    const Eigen::Vector3d centre = left_from_world * point.position_mm;
    const Eigen::Vector2d pixel = projectPoint(left, centre);
    const Eigen::Vector3d normal =
        left_from_world.linear() *
        model.normals[static_cast<std::size_t>(point.model_point)].cast<double>();
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d step = liftPixel(left, pixel.x() + (k == 0), pixel.y() + (k == 1), 1.0);
      const double depth_mm = normal.dot(centre) / normal.dot(step);
      point.pixels_mm.col(k) = world_from_left.linear() * (step * depth_mm - centre);
    }
    const ConnectedSurface surface(depth, pixel, left.fx_px, FirstLook::kReachPx);
    point.look = FirstLook::take(picture, pixel, surface.found() ? &surface : nullptr);
  };
  parallelRanges(static_cast<int>(points.size()), kLooksPerTask, [&](int begin, int end) {
    std::for_each(points.begin() + begin, points.begin() + end, lookAt);
  });
}

void MaterialPoints::align(const LookSearcher& findLooks, const PinholeCamera& left,
                           const Eigen::Isometry3d& world_from_left, double node_spacing_mm,
                           const std::function<bool(const Eigen::Vector3d&)>& inSight) {
  if (points.empty()) return;
  const FirstLookSearch search{left, world_from_left};
  const Eigen::Isometry3d left_from_world = world_from_left.inverse();
  std::vector<SeenLook> seen(points.size());
  std::vector<SoughtLook> sought;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].position_mm.allFinite()) continue;
    const Eigen::Vector3d centre = left_from_world * points[k].position_mm;
    seen[k].in_sight = inSight(centre);
    if (seen[k].in_sight) sought.push_back(search.sought(points[k], k, centre));
  }
  const std::vector<FoundLook> looks = findLooks(sought);
  for (std::size_t i = 0; i < sought.size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(sought[i].number);
    search.tell(points[k], sought[i], looks[i], &seen[k]);
  }
  const double drift_now_mm2 = driftOf(points, seen);
  if (std::isfinite(drift_now_mm2)) drift_mm2 = drift_now_mm2;
  std::vector<FoundMove> found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    double& variance_mm2 = points[k].variance_mm2;
    variance_mm2 = seen[k].in_sight ? variance_mm2 + drift_mm2 : kNotMeasured<double>;
    if (seen[k].found) found.push_back(moveTowards(seen[k], &points[k]));
  }
  parallelRanges(static_cast<int>(points.size()), kLooksPerTask, [&](int begin, int end) {
    for (std::size_t k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      if (!seen[k].found && points[k].position_mm.allFinite())
        points[k].position_mm +=
            moveOfNeighbours(found, points[k].position_mm, node_spacing_mm / 2);
  });
}

}  // namespace softscope
