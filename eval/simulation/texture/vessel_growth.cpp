// eval/simulation/texture/vessel_growth.cpp: random walks on the surface that create segments.
#include "eval/simulation/texture/vessel_growth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "eval/simulation/noise/random.h"
#include "eval/simulation/surface/ray_tree.h"
#include "eval/simulation/surface/surface_normals.h"
#include "eval/simulation/texture/texture_settings.h"

namespace softscope {
namespace {

constexpr float kThinnest_mm = 0.035F;
constexpr std::size_t kMostSegments = 150000;  // upper limit for large surfaces
constexpr float kAbove_mm = 2.0F;              // height from which the surface is searched

struct Place {
  Eigen::Vector3f point_mm, normal;
};

struct Walker {
  Place place;
  Eigen::Vector3f heading;  // unit length, tangential
  float radius_mm;
  float left_mm;      // remaining length
  float turn_per_mm;  // rad
  bool is_vein;
  bool surfaces = false;  // trunk that emerges from below the surface
};

class Grower {
 public:
  Grower(const TriangleMesh& mesh, std::uint64_t seed)
      : mesh_(mesh),
        normals_(vertexNormals(mesh.vertices_mm, mesh.triangles)),
        tree_(mesh.vertices_mm, mesh.triangles),
        random_(seed) {}

  std::vector<VesselSegment> grow(const VesselOptions& options) {
    const double area_mm2 = sumAreas();
    const double cell_mm2 = options.trunk_spacing_mm * options.trunk_spacing_mm;
    const int trunks = std::clamp(static_cast<int>(area_mm2 / cell_mm2), 1, 2000);
    for (int i = 0; i < trunks; ++i) startTrunk(options);
    while (!walkers_.empty() && segments_.size() < kMostSegments) {
      const Walker walker = walkers_.back();
      walkers_.pop_back();
      walk(walker);
    }
    return std::move(segments_);
  }

 private:
  double sumAreas() {
    double sum = 0;
    for (const Triangle& t : mesh_.triangles) {
      const Eigen::Vector3f& a = mesh_.vertices_mm[t[0]];
      sum += 0.5 * (mesh_.vertices_mm[t[1]] - a).cross(mesh_.vertices_mm[t[2]] - a).norm();
      areas_.push_back(sum);
    }
    return sum;
  }

  Place anywhere() {
    const double at = random_.uniform() * areas_.back();
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), at);
    const auto index =
        std::min<std::ptrdiff_t>(found - areas_.begin(), std::ptrdiff_t(areas_.size()) - 1);
    return placeAt({static_cast<std::int32_t>(index), 0.3F, 0.3F, 0});
  }

  Place placeAt(const RayHit& hit) const {
    const Triangle& t = mesh_.triangles[hit.triangle];
    const auto blend = [&](const std::vector<Eigen::Vector3f>& values) -> Eigen::Vector3f {
      return (1 - hit.u - hit.v) * values[t[0]] + hit.u * values[t[1]] + hit.v * values[t[2]];
    };
    return {blend(mesh_.vertices_mm), blend(normals_).normalized()};
  }

  void startTrunk(const VesselOptions& options) {
    const Place place = anywhere();
    const Eigen::Vector3f any = random_.direction().cast<float>();
    const Eigen::Vector3f heading = any.cross(place.normal).normalized();
    const float radius = float(options.trunk_radius_mm * random_.uniform(0.35, 1.0));
    add(place, heading, 0.75F * radius, false, true);
    const Eigen::Vector3f beside = place.normal.cross(heading) * (2.6F * radius);
    add({place.point_mm + beside, place.normal}, heading, radius, true, true);
  }

  void add(const Place& place, const Eigen::Vector3f& heading, float radius_mm, bool is_vein,
           bool surfaces) {
    const float length_mm = (75 * radius_mm + 1.5F) * float(random_.uniform(0.6, 1.4));
    walkers_.push_back({place, heading, radius_mm, length_mm, 0.0F, is_vein, surfaces});
  }

  void walk(Walker w) {
    const float total_mm = w.left_mm, first_radius_mm = w.radius_mm;
    while (w.left_mm > 0 && w.radius_mm > kThinnest_mm && segments_.size() < kMostSegments) {
      const float step_mm = std::clamp(w.radius_mm, 0.12F, 0.35F);
      turn(w, step_mm);
      const Eigen::Vector3f from = w.place.point_mm;
      const float from_radius_mm = shownRadius(w, total_mm);
      if (!advance(w, step_mm)) return;
      w.left_mm -= step_mm;
      w.radius_mm -= 0.5F * first_radius_mm * step_mm / total_mm;
      segments_.push_back(
          {from, w.place.point_mm, from_radius_mm, shownRadius(w, total_mm), w.is_vein});
      if (random_.uniform() < step_mm / (0.9 + 7.0 * w.radius_mm)) branch(w);
    }
  }

  /// The radius of a trunk grows from zero at its start.
  static float shownRadius(const Walker& w, float total_mm) {
    if (!w.surfaces) return w.radius_mm;
    const float walked_mm = total_mm - w.left_mm;
    return w.radius_mm * std::min(1.0F, 0.1F + walked_mm / (12 * w.radius_mm));
  }

  /// Random curvature with mean zero: vessels wind without spirals.
  void turn(Walker& w, float step_mm) {
    const float liveliness = 0.25F + 0.05F / w.radius_mm;
    w.turn_per_mm += -0.5F * step_mm * w.turn_per_mm +
                     liveliness * std::sqrt(step_mm) * float(random_.uniform(-1, 1));
    rotate(w, w.turn_per_mm * step_mm);
  }

  static void rotate(Walker& w, float angle_rad) {
    w.heading = Eigen::AngleAxisf(angle_rad, w.place.normal) * w.heading;
  }

  /// Step along the tangent, then projection onto the surface; false without a surface.
  bool advance(Walker& w, float step_mm) const {
    const Eigen::Vector3f ahead = w.place.point_mm + step_mm * w.heading;
    const RayHit hit = tree_.cast(ahead + kAbove_mm * w.place.normal, -w.place.normal);
    if (!hit.met() || std::abs(hit.distance - kAbove_mm) > 2 * step_mm) return false;
    w.place = placeAt(hit);
    w.heading = (w.heading - w.heading.dot(w.place.normal) * w.place.normal).normalized();
    return true;
  }

  void branch(Walker& w) {
    const float child_mm = w.radius_mm * float(random_.uniform(0.45, 0.78));
    if (child_mm < kThinnest_mm) return;
    const float side = random_.uniform() < 0.5 ? -1.0F : 1.0F;
    const float angle_rad = side * float(random_.uniform(0.45, 1.15));
    Walker child = w;
    rotate(child, angle_rad);
    add(w.place, child.heading, child_mm, w.is_vein, false);
    w.radius_mm = std::cbrt(std::pow(w.radius_mm, 3.0F) - 0.6F * std::pow(child_mm, 3.0F));
    rotate(w, -0.2F * angle_rad);
  }

  const TriangleMesh& mesh_;
  std::vector<Eigen::Vector3f> normals_;
  RayTree tree_;
  SeededRandom random_;
  std::vector<double> areas_;  // cumulative sums, mm^2
  std::vector<Walker> walkers_;
  std::vector<VesselSegment> segments_;
};

}  // namespace

void VesselOptions::validate() const { requireAllowed(*this); }

std::vector<VesselSegment> growVessels(const TriangleMesh& rest_mesh, const VesselOptions& options,
                                       std::uint64_t seed) {
  options.validate();
  if (options.trunk_radius_mm == 0) return {};
  return Grower(rest_mesh, seed).grow(options);
}

}  // namespace softscope
