// eval/simulation/tissue/organ_mesh.cpp: cube grid projected to an ellipsoid, with lobes and folds.
#include "eval/simulation/tissue/organ_mesh.h"

#include <cmath>
#include <unordered_map>

#include "core/error.h"
#include "eval/simulation/noise/noise.h"
#include "eval/simulation/tissue/tissue_settings.h"

namespace softscope {
namespace {

/// Vertices of a grid on the surface of a cube, one per lattice point, numbered on first use.
class CubeGrid {
 public:
  explicit CubeGrid(int cells) : cells_(cells) {}

  std::int32_t vertex(int x, int y, int z) {
    const std::int64_t side = cells_ + 1;
    const auto [place, is_new] =
        numbers_.try_emplace((x * side + y) * side + z, static_cast<std::int32_t>(points_.size()));
    if (is_new) points_.push_back(direction(x, y, z));
    return place->second;
  }
  const std::vector<Eigen::Vector3d>& directions() const { return points_; }

 private:
  /// The tangent equalises cell sizes over the sphere.
  double warped(int i) const { return std::tan((2.0 * i / cells_ - 1) * M_PI / 4); }
  Eigen::Vector3d direction(int x, int y, int z) const {
    return Eigen::Vector3d(warped(x), warped(y), warped(z)).normalized();
  }

  int cells_;
  std::unordered_map<std::int64_t, std::int32_t> numbers_;
  std::vector<Eigen::Vector3d> points_;
};

void addQuad(TriangleMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// Six faces, counter-clockwise seen from outside.
void addFaces(TriangleMesh& mesh, CubeGrid& grid, int n) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (const int w : {0, n}) {
        const int i0 = w ? i : i + 1, i1 = w ? i + 1 : i;  // opposite faces have the opposite order
        addQuad(mesh, grid.vertex(i0, j, w), grid.vertex(i1, j, w), grid.vertex(i1, j + 1, w),
                grid.vertex(i0, j + 1, w));
        addQuad(mesh, grid.vertex(w, i0, j), grid.vertex(w, i1, j), grid.vertex(w, i1, j + 1),
                grid.vertex(w, i0, j + 1));
        addQuad(mesh, grid.vertex(j, w, i0), grid.vertex(j, w, i1), grid.vertex(j + 1, w, i1),
                grid.vertex(j + 1, w, i0));
      }
}

/// Elevation above the ellipsoid at a position on the unit sphere.
double reliefMm(const Eigen::Vector3f& d, const OrganOptions& options, std::uint32_t seed) {
  const float lobes = fractalNoise(1.6F * d, 2, seed);
  const Eigen::Vector3f warped = d + 0.18F * vectorNoise(2.5F * d, seed + 11);
  const float crease = std::abs(smoothNoise(3.1F * warped, seed + 23));
  const float fold = 1 - smoothStep(0.0F, 0.22F, crease);  // 1 at the bottom of a fold
  const float swelling = smoothNoise(6.5F * warped, seed + 37);
  return options.lobe_mm * 1.8 * lobes - options.fold_mm * fold + 0.25 * options.fold_mm * swelling;
}

}  // namespace

void OrganOptions::validate() const {
  requireAllowed(*this);
  require(lobe_mm <= 0.1 * length_mm, "organ.lobe_mm", lobe_mm,
          "must be at most a tenth of organ.length_mm");
  require(fold_mm <= 0.05 * length_mm, "organ.fold_mm", fold_mm,
          "must be at most a twentieth of organ.length_mm");
}

TriangleMesh makeOrganMesh(const OrganOptions& options, std::uint64_t seed) {
  options.validate();
  TriangleMesh mesh;
  CubeGrid grid(options.cells_per_side);
  addFaces(mesh, grid, options.cells_per_side);
  const Eigen::Array3d radii_mm = 0.5 * options.length_mm * Eigen::Array3d(1.0, 0.88, 0.6);
  for (const Eigen::Vector3d& d : grid.directions()) {
    const Eigen::Vector3d on_ellipsoid = (d.array() * radii_mm).matrix();
    const Eigen::Vector3d outward = (d.array() / radii_mm).matrix().normalized();
    const double relief_mm = reliefMm(d.cast<float>(), options, static_cast<std::uint32_t>(seed));
    mesh.vertices_mm.push_back((on_ellipsoid + relief_mm * outward).cast<float>());
  }
  return mesh;
}

}  // namespace softscope
