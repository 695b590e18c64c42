// src/mesh/surface_from_points.cpp: local Delaunay fans, and the triangles common to them.
#include "mesh/surface_from_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/median.h"
#include "core/parallel.h"
#include "mesh/border_trim.h"
#include "mesh/growing_surface.h"
#include "mesh/local_fan.h"
#include "mesh/point_grid.h"
#include "mesh/surface_pieces.h"

namespace softscope {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr float kCrowded = 0.3f;  // relative to the spacing: closer points cause slivers
constexpr float kNoise = 0.3f;    // relative to the spacing: smaller steps are ignored
constexpr double kSharpestTip_deg = 40;
constexpr std::size_t kSampled = 2000;  // sample size of the spacing

/// Valid points of the cloud with their indices.
struct FitPoints {
  OrientedPoints points;
  std::vector<std::int32_t> places;

  void add(const Eigen::Vector3f& position_mm, const Eigen::Vector3f& normal, std::int32_t place) {
    points.positions_mm.push_back(position_mm);
    points.normals.push_back(normal);
    places.push_back(place);
  }
};

FitPoints fitPoints(const PointCloud& cloud) {
  if (cloud.points_mm.empty()) throw InputError("there are no points, so there is no surface");
  if (cloud.normals.size() != cloud.points_mm.size())
    throw InputError(
        "the points have no normals, which define the orientation; give points with nx ny nz");
  FitPoints fit;
  for (std::size_t i = 0; i < cloud.points_mm.size(); ++i) {
    const float length = cloud.normals[i].norm();
    if (cloud.points_mm[i].allFinite() && length > 0.5f && length < 2)
      fit.add(cloud.points_mm[i], cloud.normals[i] / length, std::int32_t(i));
  }
  if (fit.places.empty())
    throw InputError("none of the " + std::to_string(cloud.points_mm.size()) +
                     " points is finite and has a normal of length 1");
  return fit;
}

/// Robust extent along the longest axis.
float extentOf(const std::vector<Eigen::Vector3f>& points_mm) {
  float extent = 0;
  std::vector<float> places(points_mm.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points_mm.begin(), points_mm.end(), places.begin(),
                   [axis](const Eigen::Vector3f& p) { return p[axis]; });
    const auto low = places.begin() + std::ptrdiff_t(places.size() / 50);
    const auto high = places.end() - 1 - std::ptrdiff_t(places.size() / 50);
    std::nth_element(places.begin(), low, places.end());
    const float first = *low;
    std::nth_element(places.begin(), high, places.end());
    extent = std::max(extent, *high - first);
  }
  return extent;
}

/// Median distance of a point to the nearest one of similar orientation.
float spacingOf(const OrientedPoints& points, float least_cosine) {
  const std::vector<Eigen::Vector3f>& points_mm = points.positions_mm;
  const float extent = extentOf(points_mm);
  if (!(extent > 0))
    throw InputError("the " + std::to_string(points_mm.size()) +
                     " points lie in one place, so there is no surface");
  const float cell = 2 * extent / std::sqrt(float(points_mm.size()));
  const PointGrid grid(points_mm, cell);
  std::vector<float> distances;
  for (std::size_t i = 0; i < points_mm.size(); i += 1 + points_mm.size() / kSampled) {
    float nearest = cell;
    grid.visitAround(points_mm[i], cell, [&](std::int32_t other) {
      const float distance = (points_mm[std::size_t(other)] - points_mm[i]).norm();
      const float cosine = points.normals[std::size_t(other)].dot(points.normals[i]);
      if (distance > 0 && cosine >= least_cosine) nearest = std::min(nearest, distance);
    });
    distances.push_back(nearest);
  }
  return medianOf(std::move(distances));
}

NeighbourRule ruleFor(const SurfaceOptions& options, float spacing_mm) {
  NeighbourRule rule;
  rule.least_cosine = float(std::cos(options.max_angle_deg * kHalfTurn / 180));
  rule.most_step = float(std::sin(options.max_step_deg * kHalfTurn / 180));
  rule.noise_mm = kNoise * spacing_mm;
  rule.hole_radius_mm =
      float(options.gap_mm > 0 ? options.gap_mm : options.gap_spacings * double(spacing_mm)) / 2;
  return rule;
}

/// Keeps the first of nearly coincident points. Compares with kept
/// points only, so that many coincident points have linear cost.
FitPoints spreadOut(const FitPoints& all, const NeighbourRule& rule, float least_mm) {
  const PointGrid grid(all.points.positions_mm, least_mm);
  std::vector<std::vector<std::int32_t>> kept(grid.cellCount());
  FitPoints spread;
  for (std::size_t i = 0; i < all.places.size(); ++i) {
    bool room = true;
    const Eigen::Vector3f& centre = all.points.positions_mm[i];
    grid.visitCells(centre, least_mm, [&](std::size_t cell) {
      for (const std::int32_t other : kept[cell])
        room = room && !((all.points.positions_mm[std::size_t(other)] - centre).norm() < least_mm &&
                         rule.join(all.points, std::int32_t(i), other));
    });
    if (!room) continue;
    kept[grid.cellAt(centre)].push_back(std::int32_t(i));
    spread.add(centre, all.points.normals[i], all.places[i]);
  }
  return spread;
}

/// Candidate triangle, lowest index first.
struct Candidate {
  Triangle triangle;
  float radius_mm;
  int votes;
};

std::vector<Candidate> candidateTriangles(const OrientedPoints& points, const PointGrid& grid,
                                          const NeighbourRule& rule) {
  std::vector<std::vector<FanTriangle>> fans(points.positions_mm.size());
  parallelRanges(int(fans.size()), 500, [&](int begin, int end) {
    LocalFan fan(points, grid, rule);
    for (int i = begin; i < end; ++i) fans[std::size_t(i)] = fan.around(i);
  });
  std::vector<Candidate> candidates;
  candidates.reserve(6 * fans.size());
  for (std::size_t i = 0; i < fans.size(); ++i)
    for (const FanTriangle& fan_triangle : fans[i]) {
      Triangle t{std::int32_t(i), fan_triangle.first, fan_triangle.second};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      candidates.push_back({t, fan_triangle.radius_mm, 1});
    }
  return candidates;
}

/// Unique triangles; sorted by the number of supporting points, then by size.
std::vector<Candidate> ranked(std::vector<Candidate> candidates) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.radius_mm < b.radius_mm;
  });
  std::vector<Candidate> once;
  for (const Candidate& candidate : candidates)
    if (!once.empty() && once.back().triangle == candidate.triangle)
      ++once.back().votes;
    else
      once.push_back(candidate);
  std::stable_sort(once.begin(), once.end(), [](const Candidate& a, const Candidate& b) {
    return a.votes != b.votes ? a.votes > b.votes : a.radius_mm < b.radius_mm;
  });
  return once;
}

void fill(const PointCloud& cloud, const FitPoints& fit, SurfacePieces pieces,
          PointSurface& surface) {
  surface.mesh.triangles = std::move(pieces.triangles);
  surface.dropped_islands = pieces.dropped_pieces;
  for (const std::int32_t point : pieces.points) {
    const auto place = std::size_t(fit.places[std::size_t(point)]);
    surface.mesh.vertices_mm.push_back(cloud.points_mm[place]);
    surface.normals.push_back(fit.points.normals[std::size_t(point)]);
    if (!cloud.colours.empty()) surface.mesh.colours.push_back(cloud.colours[place]);
    surface.points.push_back(std::int32_t(place));
  }
  pieces.points.erase(std::unique(pieces.points.begin(), pieces.points.end()), pieces.points.end());
  surface.dropped_points = fit.places.size() - pieces.points.size();
  if (surface.mesh.empty())
    throw InputError("no surface came about from " + std::to_string(cloud.points_mm.size()) +
                     " points: their distances are too large or their orientations differ; a "
                     "larger gap may help");
}

}  // namespace

void SurfaceOptions::validate() const {
  require(gap_mm >= 0 && std::isfinite(gap_mm), "gap_mm", gap_mm, "must be 0 (automatic) or more");
  require(gap_spacings >= 2 && gap_spacings <= 100, "gap_spacings", gap_spacings,
          "must be 2 to 100 times the points' spacing");
  require(max_angle_deg > 0 && max_angle_deg < 90, "max_angle_deg", max_angle_deg,
          "must be above 0 and below 90");
  require(max_step_deg > 0 && max_step_deg < 90, "max_step_deg", max_step_deg,
          "must be above 0 and below 90");
  require(least_island_mm2 >= 0, "least_island_mm2", least_island_mm2, "can't be negative");
}

PointSurface surfaceFromPoints(const PointCloud& cloud, const SurfaceOptions& options) {
  options.validate();
  const FitPoints fit = fitPoints(cloud);
  PointSurface surface;
  surface.invalid_points = cloud.points_mm.size() - fit.places.size();
  const auto least_cosine = float(std::cos(options.max_angle_deg * kHalfTurn / 180));
  const float spacing_mm = spacingOf(fit.points, least_cosine);
  const NeighbourRule rule = ruleFor(options, spacing_mm);
  surface.spacing_mm = spacing_mm;
  surface.gap_mm = 2 * double(rule.hole_radius_mm);
  const FitPoints spread = spreadOut(fit, rule, kCrowded * spacing_mm);
  surface.crowded_points = fit.places.size() - spread.places.size();
  const PointGrid grid(spread.points.positions_mm, rule.hole_radius_mm / 2);
  GrowingSurface growing(spread.points, rule.least_cosine);
  for (const Candidate& candidate : ranked(candidateTriangles(spread.points, grid, rule)))
    growing.add(candidate.triangle);
  growing.closeHoles(kHalfTurn * surface.gap_mm);  // circumference of a circle of this width
  const std::vector<Eigen::Vector3f>& places_mm = spread.points.positions_mm;
  const std::vector<Triangle> triangles =
      withoutSplinters(places_mm, growing.triangles(), kSharpestTip_deg);
  fill(cloud, spread, assemblePieces(places_mm, triangles, options.least_island_mm2), surface);
  return surface;
}

}  // namespace softscope
