// eval/simulation/wound/incision.cpp: entry point of the blade, and feasibility checks.
#include "eval/simulation/wound/incision.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/simulation/noise/noise.h"
#include "eval/simulation/surface/ray_tree.h"
#include "eval/simulation/surface/surface_normals.h"
#include "eval/simulation/wound/cut_path.h"
#include "eval/simulation/wound/incision_settings.h"
#include "eval/simulation/wound/wound_walls.h"

namespace softscope {
namespace {

constexpr double kSegments = 12;     // approximate minimum number of segments of a cut
constexpr float kLeastBelow_mm = 1;  // minimum thickness of tissue below a cut
constexpr float kUnderSkin_mm = 0.1F;

/// First tissue along the view ray at the centre of the cut.
RayHit entryOf(const RayTree& tree, const CutOptions& options, const Eigen::Vector3f& from_mm,
               const Eigen::Vector3f& forward) {
  const RayHit hit = tree.cast(from_mm, forward);
  require(hit.met(), "cut.x_mm, cut.y_mm",
          std::to_string(options.x_mm) + ", " + std::to_string(options.y_mm),
          "the view ray misses the organ there; choose a place on it");
  return hit;
}

/// Mean of the nearby normals that have the orientation of the triangle itself.
Eigen::Vector3f outwardAround(const TriangleMesh& organ, const Eigen::Vector3f& middle_mm,
                              const Triangle& triangle, double length_mm) {
  const std::vector<Eigen::Vector3f> normals = vertexNormals(organ.vertices_mm, organ.triangles);
  const Eigen::Vector3f& a = organ.vertices_mm[triangle[0]];
  const Eigen::Vector3f own =
      (organ.vertices_mm[triangle[1]] - a).cross(organ.vertices_mm[triangle[2]] - a).normalized();
  Eigen::Vector3f sum = own;
  for (std::size_t i = 0; i < normals.size(); ++i)
    if ((organ.vertices_mm[i] - middle_mm).norm() < float(length_mm / 2) &&
        normals[i].dot(own) > 0.3F)
      sum += normals[i];
  return sum.normalized();
}

IncisionPlane planeOf(const TriangleMesh& organ, const RayTree& tree, const CutOptions& options,
                      const Eigen::Isometry3d& body_from_view) {
  float away_mm = 0;
  for (const Eigen::Vector3f& p : organ.vertices_mm)
    away_mm = std::max(away_mm, (p - body_from_view.translation().cast<float>()).norm());
  const Eigen::Vector3d start(options.x_mm, options.y_mm, -double(away_mm));
  const Eigen::Vector3f from_mm = (body_from_view * start).cast<float>();
  const Eigen::Vector3f forward = body_from_view.linear().col(2).cast<float>();
  const RayHit hit = entryOf(tree, options, from_mm, forward);
  IncisionPlane plane;
  plane.length_mm = options.length_mm;
  plane.middle_mm = from_mm + hit.distance * forward;
  plane.out =
      outwardAround(organ, plane.middle_mm, organ.triangles[hit.triangle], options.length_mm);
  const double angle_rad = options.angle_deg * M_PI / 180;
  const Eigen::Vector3d along(std::cos(angle_rad), std::sin(angle_rad), 0);
  const Eigen::Vector3f wanted = (body_from_view.linear() * along).cast<float>();
  const Eigen::Vector3f across = plane.out.cross(wanted);
  require(across.norm() > 0.2F, "cut.angle_deg", options.angle_deg,
          "that points into the organ there; turn the cut, or move it by cut.x_mm and cut.y_mm");
  plane.along = across.normalized().cross(plane.out);
  return plane;
}

/// Depth of the cut at each vertex of its path.
std::vector<double> depthsOf(const CutPath& path, const CutOptions& options) {
  std::vector<double> depths_mm;
  for (const double along_mm : path.along_mm) {
    const double share = 2 * along_mm / options.length_mm;
    depths_mm.push_back(options.depth_mm * std::sqrt(std::max(0.0, 1 - share * share)));
  }
  return depths_mm;
}

void requireTissueBelow(const RayTree& tree, const SplittingMesh& mesh, const CutPath& path,
                        const std::vector<double>& depths_mm, const IncisionPlane& plane,
                        const CutOptions& options) {
  for (std::size_t i = 1; i + 1 < path.vertices.size(); ++i) {
    const Eigen::Vector3f inside_mm = mesh.vertices()[path.vertices[i]] - kUnderSkin_mm * plane.out;
    const RayHit hit = tree.cast(inside_mm, -plane.out);
    const float thick_mm = hit.met() ? hit.distance + kUnderSkin_mm : 0;
    require(thick_mm >= float(depths_mm[i]) + kLeastBelow_mm, "cut.depth_mm", options.depth_mm,
            "the organ is " + std::to_string(std::lround(thick_mm)) +
                " mm thick under the cut; leave 1 mm of it");
  }
}

}  // namespace

void CutOptions::validate() const {
  requireAllowed(*this);
  require(length_mm == 0 || length_mm >= 3, "cut.length_mm", length_mm,
          "must be 0 (no cut) or 3 to 200");
  require(length_mm == 0 || opening_mm <= length_mm / 2, "cut.opening_mm", opening_mm,
          "must be at most half of cut.length_mm");
}

float CutOptions::openAt(double time_s) const {
  return smoothStep(0, 1, static_cast<float>((time_s - start_s) / duration_s));
}

TissueBody cutTissue(const TriangleMesh& organ, const CutOptions& options,
                     const Eigen::Isometry3d& body_from_view) {
  options.validate();
  if (!options.there()) return TissueBody::whole(organ);
  const RayTree tree(organ.vertices_mm, organ.triangles);
  const IncisionPlane plane = planeOf(organ, tree, options, body_from_view);
  SplittingMesh mesh(organ);
  refineAround(mesh, plane, options.length_mm / kSegments);
  const CutPath path = layPath(mesh, plane);
  const std::vector<double> depths_mm = depthsOf(path, options);
  requireTissueBelow(tree, mesh, path, depths_mm, plane, options);
  return openWound(organ, mesh, plane, path, depths_mm, options.opening_mm);
}

}  // namespace softscope
