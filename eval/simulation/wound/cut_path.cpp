// eval/simulation/wound/cut_path.cpp: path from the centre in both directions.
#include "eval/simulation/wound/cut_path.h"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "core/error.h"

namespace softscope {
namespace {

constexpr float kLeastFacing = 0.4F;  // cosine of the angle between line and direction: 66 degrees

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Edge of the lines that contains the centre, its farther end last.
Edge middleEdge(const SplittingMesh& mesh, const IncisionPlane& plane, const PlaneLines& lines) {
  Edge found{-1, -1};
  float nearest_mm = std::numeric_limits<float>::max();
  for (const auto& [a, list] : lines)
    for (const std::int32_t b : list) {
      const Eigen::Vector3f way = mesh.vertices()[b] - mesh.vertices()[a];
      if (way.dot(plane.along) <= 0) continue;
      const Eigen::Vector3f to = plane.middle_mm - mesh.vertices()[a];
      const float share = std::clamp(to.dot(way) / way.squaredNorm(), 0.0F, 1.0F);
      if (const float off_mm = (to - share * way).norm(); off_mm < nearest_mm) {
        nearest_mm = off_mm;
        found = {a, b};
      }
    }
  if (found.first < 0)
    throw InputError("the cut finds no edges where it begins; is the mesh a surface there?");
  return found;
}

std::string turnsAway(double length_mm) {
  std::ostringstream text;
  text << "cut.length_mm is " << length_mm
       << ", but the surface turns away from the cut before that; shorten it, turn it by "
          "cut.angle_deg or move it by cut.x_mm and cut.y_mm";
  return text.str();
}

/// One direction along the plane from the edge (from, to).
class Walk {
 public:
  Walk(SplittingMesh& mesh, const IncisionPlane& plane, const PlaneLines& lines, float sign)
      : mesh_(mesh), plane_(plane), lines_(lines), sign_(sign) {}

  /// Appends vertices up to half of the length; the last one is there, or at a vertex nearby.
  void go(std::int32_t from, std::int32_t to, double start_mm, CutPath& path) {
    const double end_mm = plane_.length_mm / 2;
    double here_mm = start_mm;
    while (true) {
      const double edge_mm = length(from, to);
      if (here_mm + edge_mm >= end_mm) return finish(from, to, end_mm - here_mm, path);
      here_mm += edge_mm;
      append(to, here_mm, path);
      const std::int32_t next = straightest(from, to);
      from = to;
      to = next;
    }
  }

 private:
  double length(std::int32_t a, std::int32_t b) const {
    return (mesh_.vertices()[b] - mesh_.vertices()[a]).cast<double>().norm();
  }
  float facing(std::int32_t a, std::int32_t b) const {
    return sign_ * (mesh_.vertices()[b] - mesh_.vertices()[a]).normalized().dot(plane_.along);
  }
  void append(std::int32_t vertex, double here_mm, CutPath& path) const {
    path.vertices.push_back(vertex);
    path.along_mm.push_back(sign_ * here_mm);
  }
  std::int32_t straightest(std::int32_t from, std::int32_t at) const {
    std::int32_t best = -1;
    float straight = kLeastFacing;
    for (const std::int32_t next : lines_.at(at))
      if (next != from && facing(at, next) > straight) {
        straight = facing(at, next);
        best = next;
      }
    if (best < 0) throw OptionError(turnsAway(plane_.length_mm));
    return best;
  }
  /// The end is `rest_mm` along the edge, which is split there unless it is close to a vertex.
  void finish(std::int32_t from, std::int32_t to, double rest_mm, CutPath& path) {
    const double share = rest_mm / length(from, to), end_mm = plane_.length_mm / 2;
    if (share >= 1 - kSnapShare) return append(to, end_mm, path);
    if (share > kSnapShare || path.vertices.empty() || path.vertices.back() != from)
      return append(mesh_.split(from, to, std::max(share, double(kSnapShare))), end_mm, path);
    path.along_mm.back() = sign_ * end_mm;
  }

  SplittingMesh& mesh_;
  const IncisionPlane& plane_;
  const PlaneLines& lines_;
  float sign_;
};

}  // namespace

CutPath layPath(SplittingMesh& mesh, const IncisionPlane& plane) {
  const PlaneLines lines = splitByPlane(mesh, plane);
  const auto [back, front] = middleEdge(mesh, plane, lines);
  const Eigen::Vector3f to_front = mesh.vertices()[front] - plane.middle_mm;
  const Eigen::Vector3f to_back = mesh.vertices()[back] - plane.middle_mm;
  CutPath path, ahead;
  Walk(mesh, plane, lines, -1).go(front, back, -double(to_front.norm()), path);
  Walk(mesh, plane, lines, 1).go(back, front, -double(to_back.norm()), ahead);
  std::reverse(path.vertices.begin(), path.vertices.end());
  std::reverse(path.along_mm.begin(), path.along_mm.end());
  path.vertices.insert(path.vertices.end(), ahead.vertices.begin(), ahead.vertices.end());
  path.along_mm.insert(path.along_mm.end(), ahead.along_mm.begin(), ahead.along_mm.end());
  const std::set<std::int32_t> distinct(path.vertices.begin(), path.vertices.end());
  if (distinct.size() != path.vertices.size()) throw OptionError(turnsAway(plane.length_mm));
  return path;
}

}  // namespace softscope
