// eval/simulation/wound/plane_split.cpp: classification of edges against a plane.
#include "eval/simulation/wound/plane_split.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <utility>

namespace softscope {
namespace {

constexpr double kNear = 0.75;  // in lengths of the cut, around its centre

using Edge = std::pair<std::int32_t, std::int32_t>;

bool isNear(const SplittingMesh& mesh, const Triangle& triangle, const IncisionPlane& plane) {
  Eigen::AlignedBox3f box;
  for (const std::int32_t vertex : triangle) box.extend(mesh.vertices()[vertex]);
  return box.exteriorDistance(plane.middle_mm) < float(kNear * plane.length_mm);
}

/// Sorted, unique, lower vertex first.
std::set<Edge> edgesNear(const SplittingMesh& mesh, const IncisionPlane& plane) {
  std::set<Edge> edges;
  for (const Triangle& t : mesh.triangles()) {
    if (!isNear(mesh, t, plane)) continue;
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  return edges;
}

/// Vertices on the plane, within a tolerance.
class PlaneSides {
 public:
  PlaneSides(const SplittingMesh& mesh, const IncisionPlane& plane, const std::set<Edge>& edges) {
    const Eigen::Vector3f left = plane.left();
    for (const Eigen::Vector3f& p : mesh.vertices())
      off_mm_.push_back(left.dot(p - plane.middle_mm));
    std::vector<std::int32_t> snapped;
    for (const auto& [a, b] : edges) {
      if (off_mm_[a] * off_mm_[b] > 0) continue;
      const float share = shareOf(a, b);
      if (share <= kSnapShare) snapped.push_back(a);
      if (share >= 1 - kSnapShare) snapped.push_back(b);
    }
    for (const std::int32_t vertex : snapped) off_mm_[vertex] = 0;
  }
  bool on(std::int32_t vertex) const { return off_mm_[vertex] == 0; }
  bool crossed(std::int32_t a, std::int32_t b) const { return off_mm_[a] * off_mm_[b] < 0; }
  /// Position of the intersection between a and b, 0 to 1.
  float shareOf(std::int32_t a, std::int32_t b) const {
    const float way = off_mm_[a] - off_mm_[b];
    return way == 0 ? 0 : off_mm_[a] / way;
  }
  void addOnPlane() { off_mm_.push_back(0); }

 private:
  std::vector<float> off_mm_;  // one per vertex
};

}  // namespace

void refineAround(SplittingMesh& mesh, const IncisionPlane& plane, double longest_mm) {
  for (std::size_t i = 0; i < mesh.triangles().size();) {
    const Triangle t = mesh.triangles()[i];
    int longest = 0;
    double most_mm = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f side = mesh.vertices()[t[(k + 1) % 3]] - mesh.vertices()[t[k]];
      if (side.norm() > most_mm) {
        most_mm = side.norm();
        longest = k;
      }
    }
    if (most_mm <= longest_mm || !isNear(mesh, t, plane))
      ++i;
    else
      mesh.split(t[longest], t[(longest + 1) % 3], 0.5);
  }
}

PlaneLines splitByPlane(SplittingMesh& mesh, const IncisionPlane& plane) {
  const std::set<Edge> before = edgesNear(mesh, plane);
  PlaneSides sides(mesh, plane, before);
  for (const auto& [a, b] : before)
    if (sides.crossed(a, b)) {
      mesh.split(a, b, sides.shareOf(a, b));
      sides.addOnPlane();
    }
  PlaneLines lines;
  for (const auto& [a, b] : edgesNear(mesh, plane))
    if (sides.on(a) && sides.on(b)) {
      lines[a].push_back(b);
      lines[b].push_back(a);
    }
  return lines;
}

}  // namespace softscope
