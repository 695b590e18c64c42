// vtk_views/scenes/point_splats.cpp: neighbours from a grid, tangent planes from their covariance.
#include "vtk_views/scenes/point_splats.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "vtk_views/scenes/point_spacing.h"

namespace softscope {
namespace {

constexpr int kRim = 8;                        // corners of a splat
constexpr std::size_t kNearest = 8;            // neighbours of a point
constexpr double kReach = 2.5;                 // search radius, in units of the spacing
constexpr float kWidth = 1.0f;                 // radius, in distances to the third neighbour
constexpr float kLeast = 0.95f, kMost = 1.8f;  // limits of the radius, in units of the spacing
constexpr float kApex = 0.05f;                 // height of the cone, in units of its radius
constexpr float kMixing = 0.5f;                // smoothing radius of colours, in spacings

/// Written out: where clang does not inline Eigen, as under sanitizers, its norm took a third of
/// the time of a drawing.
float distanceOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const float x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
  return std::sqrt(x * x + (y * y + z * z));
}

/// Points sorted by grid cell.
class SplatGrid {
 public:
  SplatGrid(const std::vector<Eigen::Vector3f>& points_mm, float cell_mm)
      : points_mm_(points_mm), cell_mm_(cell_mm) {
    for (std::size_t i = 0; i < points_mm.size(); ++i)
      cells_.emplace_back(keyOf(cellOf(points_mm[i])), static_cast<std::int32_t>(i));
    std::sort(cells_.begin(), cells_.end());
  }

  /// Nearest neighbours within the width of a cell, in ascending distance.
  std::vector<std::pair<float, std::int32_t>> near(std::int32_t i) const {
    const Eigen::Vector3f& p = points_mm_[std::size_t(i)];
    const Eigen::Vector3i at = cellOf(p);
    std::vector<std::pair<float, std::int32_t>> found;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const std::uint64_t key = keyOf(at + Eigen::Vector3i(dx, dy, dz));
          for (auto cell = std::lower_bound(cells_.begin(), cells_.end(),
                                            std::make_pair(key, std::int32_t{0}));
               cell != cells_.end() && cell->first == key; ++cell) {
            const float away = distanceOf(points_mm_[std::size_t(cell->second)], p);
            if (cell->second != i && away <= cell_mm_) found.emplace_back(away, cell->second);
          }
        }
    const std::size_t kept = std::min(found.size(), kNearest);
    std::partial_sort(found.begin(), found.begin() + std::ptrdiff_t(kept), found.end());
    found.resize(kept);
    return found;
  }

 private:
  Eigen::Vector3i cellOf(const Eigen::Vector3f& p) const {
    return (p / cell_mm_).array().floor().cast<int>();
  }
  static std::uint64_t keyOf(const Eigen::Vector3i& cell) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 21 | (static_cast<std::uint64_t>(cell[axis] + (1 << 20)) & 0x1FFFFF);
    return key;
  }

  const std::vector<Eigen::Vector3f>& points_mm_;
  float cell_mm_;
  std::vector<std::pair<std::uint64_t, std::int32_t>> cells_;
};

using Neighbours = std::vector<std::pair<float, std::int32_t>>;

class SplatMaker {
 public:
  SplatMaker(const SceneSurface& points, double scale, const Eigen::Vector3f& eye_mm)
      : points_(points),
        places_(points.mesh.vertices_mm),
        scale_(float(scale)),
        spacing_mm_(float(surfaceSpacingMm(places_))),
        eye_mm_(eye_mm),
        grid_(places_, float(kReach) * spacing_mm_) {}

  SceneSurface make() {
    SceneSurface made = points_;
    const std::size_t count = places_.size(), each = kRim + 1;
    made.mesh.vertices_mm.resize(count * each);
    made.mesh.triangles.resize(count * kRim);
    coloured_ = points_.mesh.colours.size() == count;
    judged_ = points_.errors_mm.size() == count;
    made.mesh.colours.resize(coloured_ ? count * each : 0);
    made.errors_mm.resize(judged_ ? count * each : 0);
    parallelRanges(static_cast<int>(count), kPointsPerTask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) makeOne(i, &made);
    });
    return made;
  }

 private:
  void makeOne(std::int32_t i, SceneSurface* made) const {
    const Neighbours near = grid_.near(i);
    const Eigen::Vector3f& centre = places_[std::size_t(i)];
    const Eigen::Vector3f normal = normalOf(centre, near);
    const float wanted =
        near.empty() ? spacing_mm_ : near[std::min<std::size_t>(2, near.size() - 1)].first;
    const float radius =
        scale_ * kWidth * std::clamp(wanted, kLeast * spacing_mm_, kMost * spacing_mm_);
    const Eigen::Vector3f u = normal.unitOrthogonal(), v = normal.cross(u);
    const std::size_t first = std::size_t(i) * (kRim + 1);
    put(first, centre, i, {}, made);
    for (int k = 0; k < kRim; ++k) {
      const float angle = float(2 * M_PI / kRim) * float(k);
      const Eigen::Vector3f rim =
          centre + radius * (std::cos(angle) * u + std::sin(angle) * v) - kApex * radius * normal;
      put(first + std::size_t(k) + 1, rim, i, near, made);
      const auto at = static_cast<std::int32_t>(first);
      made->mesh.triangles[std::size_t(i) * kRim + std::size_t(k)] = {at, at + 1 + k,
                                                                      at + 1 + (k + 1) % kRim};
    }
  }

  /// Direction of the smallest variance of the neighbours, towards the eye.
  Eigen::Vector3f normalOf(const Eigen::Vector3f& centre, const Neighbours& near) const {
    const Eigen::Vector3f towards = eye_mm_ - centre;
    if (near.size() < 3)
      return towards.norm() > 0 ? towards.normalized() : -Eigen::Vector3f::UnitZ();
    Eigen::Vector3d mean = centre.cast<double>();
    for (const auto& [away, j] : near) mean += places_[std::size_t(j)].cast<double>();
    mean /= double(near.size() + 1);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    const auto add = [&](const Eigen::Vector3f& place) {
      const Eigen::Vector3d way = place.cast<double>() - mean;
      spread += way * way.transpose();
    };
    add(centre);
    for (const auto& [away, j] : near) add(places_[std::size_t(j)]);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
    return normal.dot(towards) < 0 ? Eigen::Vector3f(-normal) : normal;
  }

  /// Corner with interpolated colour and error.
  void put(std::size_t at, const Eigen::Vector3f& place, std::int32_t i, const Neighbours& near,
           SceneSurface* made) const {
    made->mesh.vertices_mm[at] = place;
    float red = 0, green = 0, blue = 0;
    double error_mm = 0;
    float weights = 0, error_weights = 0;
    const auto add = [&](std::int32_t j) {
      const float away = distanceOf(place, places_[std::size_t(j)]) / (kMixing * spacing_mm_);
      const float weight = std::exp(-away * away) + 1e-6f;
      if (coloured_) {
        const Rgb8& c = points_.mesh.colours[std::size_t(j)];
        red += weight * c.red;
        green += weight * c.green;
        blue += weight * c.blue;
        weights += weight;
      }
      if (judged_ && std::isfinite(points_.errors_mm[std::size_t(j)])) {
        error_mm += double(weight) * points_.errors_mm[std::size_t(j)];
        error_weights += weight;
      }
    };
    add(i);
    for (const auto& [away, j] : near) add(j);
    if (coloured_) {
      const auto byte = [](float value) {
        return static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
      };
      made->mesh.colours[at] = {byte(red / weights), byte(green / weights), byte(blue / weights)};
    }
    if (judged_)
      made->errors_mm[at] = std::isfinite(points_.errors_mm[std::size_t(i)])
                                ? error_mm / double(error_weights)
                                : std::nan("");
  }

  const SceneSurface& points_;
  const std::vector<Eigen::Vector3f>& places_;
  float scale_, spacing_mm_;
  Eigen::Vector3f eye_mm_;
  SplatGrid grid_;
  bool coloured_ = false, judged_ = false;
};

}  // namespace

SceneSurface splatsOf(const SceneSurface& points, double scale, const Eigen::Vector3f& eye_mm) {
  if (!points.isPoints() || points.mesh.vertices_mm.empty()) return points;
  return SplatMaker(points, scale, eye_mm).make();
}

}  // namespace softscope
