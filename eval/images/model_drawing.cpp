// eval/images/model_drawing.cpp: discs with a depth buffer, weighted mean per surface.
#include "eval/images/model_drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "eval/statistics/statistics.h"

namespace softscope {
namespace {

constexpr std::size_t kSamples = 500;    // sample size of nearestNeighbourMm
constexpr double kRadiusSpacings = 1.5;  // closes the gaps of a random pattern
constexpr double kPixelRadius = 0.75;    // in pixels: a facing disc covers a pixel centre
constexpr double kDiscSigma = 0.4;       // sigma of the Gaussian, in radii
constexpr double kSurfaceRadii = 2;      // discs this far behind the nearest are of its surface
constexpr double kNearestMm = 1;         // nearer points are not drawn
constexpr int kBandRows = 16;            // rows per task

/// In the camera frame.
struct Disc {
  Eigen::Vector3d centre_mm, normal;
  double radius_mm = 0;
  double u_px = 0, v_px = 0, reach_px = 0;
  Rgb8 colour;
};

/// Intersection of the ray of a pixel with a disc; `weight` is 0 outside of the disc.
struct Hit {
  double depth_mm = 0, weight = 0;
};

Hit hitOf(const Disc& disc, const PinholeCamera& camera, int u, int v) {
  const Eigen::Vector3d ray = liftPixel<double>(camera, u, v, 1);
  const double slope = disc.normal.dot(ray);
  if (!(std::abs(slope) > 1e-9)) return {};
  const double depth_mm = disc.normal.dot(disc.centre_mm) / slope;
  const double away =
      (depth_mm * ray - disc.centre_mm).squaredNorm() / (disc.radius_mm * disc.radius_mm);
  if (!(away <= 1)) return {};
  return {depth_mm, std::exp(-away / (2 * kDiscSigma * kDiscSigma))};
}

std::vector<Disc> discsOf(const PointModel& model, const PinholeCamera& camera,
                          const Eigen::Isometry3d& world_from_left) {
  const Eigen::Isometry3d left_from_world = world_from_left.inverse();
  const double radius_mm = kRadiusSpacings * nearestNeighbourMm(model);
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < model.size(); ++i) {
    Disc disc;
    disc.centre_mm = left_from_world * model.positions_mm[i].cast<double>();
    if (!disc.centre_mm.allFinite() || disc.centre_mm.z() < kNearestMm) continue;
    disc.normal = left_from_world.linear() * model.normals[i].cast<double>();
    if (!(disc.normal.norm() > 0.5)) disc.normal = -disc.centre_mm.normalized();
    if (disc.normal.dot(disc.centre_mm) >= 0) continue;  // back-facing
    const double pixel_mm = disc.centre_mm.z() / std::min(camera.fx_px, camera.fy_px);
    disc.radius_mm = std::max(radius_mm, kPixelRadius * pixel_mm);
    const Eigen::Vector2d at = projectPoint<double>(camera, disc.centre_mm);
    disc.u_px = at.x();
    disc.v_px = at.y();
    const double nearest_mm = std::max(disc.centre_mm.z() - disc.radius_mm, kNearestMm);
    disc.reach_px = std::max(camera.fx_px, camera.fy_px) * disc.radius_mm / nearest_mm *
                    (1 + (disc.centre_mm.head<2>().norm() / disc.centre_mm.z()));
    disc.colour = model.colours[i];
    discs.push_back(disc);
  }
  return discs;
}

/// Calls `at(u, v, hit)` for each pixel of rows [first, end) inside the disc.
template <class Visit>
void forEachPixel(const Disc& disc, const PinholeCamera& camera, int first, int end,
                  const Visit& visit) {
  const auto from = [](double px) { return static_cast<int>(std::ceil(std::max(px, -1.0))); };
  const auto to = [](double px, int size) {
    return static_cast<int>(std::floor(std::min(px, size - 1.0)));
  };
  const int top = std::max(first, from(disc.v_px - disc.reach_px)),
            bottom = std::min(end - 1, to(disc.v_px + disc.reach_px, camera.height_px));
  const int left = std::max(0, from(disc.u_px - disc.reach_px)),
            right = to(disc.u_px + disc.reach_px, camera.width_px);
  for (int v = top; v <= bottom; ++v)
    for (int u = left; u <= right; ++u)
      if (const Hit hit = hitOf(disc, camera, u, v); hit.weight > 0) visit(u, v, hit);
}

struct PixelSum {
  double nearest_mm = std::numeric_limits<double>::infinity();
  double weight = 0, depth_mm = 0;
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
};

void drawRows(const std::vector<Disc>& discs, const PinholeCamera& camera, int first, int end,
              ModelDrawing* drawing) {
  Raster<PixelSum> sums(camera.width_px, end - first, PixelSum());
  for (const Disc& disc : discs)
    forEachPixel(disc, camera, first, end, [&](int u, int v, const Hit& hit) {
      PixelSum& sum = sums.at(u, v - first);
      sum.nearest_mm = std::min(sum.nearest_mm, hit.depth_mm);
    });
  for (const Disc& disc : discs)
    forEachPixel(disc, camera, first, end, [&](int u, int v, const Hit& hit) {
      PixelSum& sum = sums.at(u, v - first);
      if (hit.depth_mm > sum.nearest_mm + kSurfaceRadii * disc.radius_mm) return;
      sum.weight += hit.weight;
      sum.depth_mm += hit.weight * hit.depth_mm;
      sum.colour +=
          hit.weight * Eigen::Vector3d(disc.colour.red, disc.colour.green, disc.colour.blue);
    });
  for (int v = first; v < end; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const PixelSum& sum = sums.at(u, v - first);
      if (!(sum.weight > 0)) continue;
      drawing->depth_mm.at(u, v) = static_cast<float>(sum.depth_mm / sum.weight);
      const Eigen::Vector3d mean = sum.colour / sum.weight;
      const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
      };
      drawing->colour.at(u, v) = {byte(mean.x()), byte(mean.y()), byte(mean.z())};
    }
}

}  // namespace

double nearestNeighbourMm(const PointModel& model) {
  const auto& points_mm = model.positions_mm;
  const std::size_t samples = std::min(kSamples, points_mm.size());
  std::vector<double> nearest_mm(samples, Statistics::kNone);
  parallelRanges(static_cast<int>(samples), 8, [&](int begin, int end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const std::size_t i = k * points_mm.size() / samples;
      float least = std::numeric_limits<float>::infinity();
      for (std::size_t j = 0; j < points_mm.size(); ++j)
        if (const float away = (points_mm[j] - points_mm[i]).squaredNorm(); away < least && j != i)
          least = away;
      if (std::isfinite(least)) nearest_mm[k] = std::sqrt(least);
    }
  });
  const Statistics of = statistics(nearest_mm);
  return of.count == 0 ? 0 : of.median;
}

ModelDrawing drawModel(const PointModel& model, const PinholeCamera& camera,
                       const Eigen::Isometry3d& world_from_left) {
  ModelDrawing drawing{ColourImage(camera.width_px, camera.height_px),
                       Raster<float>(camera.width_px, camera.height_px, std::nanf(""))};
  const std::vector<Disc> discs = discsOf(model, camera, world_from_left);
  const int bands = (camera.height_px + kBandRows - 1) / kBandRows;
  std::vector<std::vector<Disc>> of_band(static_cast<std::size_t>(bands));
  for (const Disc& disc : discs)
    for (int band = 0; band < bands; ++band)
      if (disc.v_px + disc.reach_px >= band * kBandRows &&
          disc.v_px - disc.reach_px < (band + 1) * kBandRows)
        of_band[static_cast<std::size_t>(band)].push_back(disc);
  parallelRanges(bands, 1, [&](int begin, int end) {
    for (int band = begin; band < end; ++band)
      drawRows(of_band[static_cast<std::size_t>(band)], camera, band * kBandRows,
               std::min((band + 1) * kBandRows, camera.height_px), &drawing);
  });
  return drawing;
}

}  // namespace softscope
