// eval/simulation/cut_path.cpp: split by a plane, then walk along it both ways.
#include "eval/simulation/cut_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kNear = 0.75;       // lengths of the cut around its middle
constexpr float kSnap = 1.0F / 12;   // of an edge
constexpr float kLeastFacing = 0.4;  // cosine between the line and its direction: 66 degrees

using Edge = std::pair<std::int32_t, std::int32_t>;

bool isNear(const SplittingMesh& mesh, const Triangle& triangle, const CutPlane& plane) {
  Eigen::AlignedBox3f box;
  for (const std::int32_t vertex : triangle) box.extend(mesh.vertices()[vertex]);
  return box.exteriorDistance(plane.middle_mm) < float(kNear * plane.length_mm);
}

/// Sorted, each once, the lower vertex first.
std::set<Edge> edgesNear(const SplittingMesh& mesh, const CutPlane& plane) {
  std::set<Edge> edges;
  for (const Triangle& t : mesh.triangles()) {
    if (!isNear(mesh, t, plane)) continue;
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  return edges;
}

/// Which vertices count as on the plane.
class PlaneSides {
 public:
  PlaneSides(const SplittingMesh& mesh, const CutPlane& plane, const std::set<Edge>& edges) {
    const Eigen::Vector3f left = plane.left();
    for (const Eigen::Vector3f& p : mesh.vertices())
      off_mm_.push_back(left.dot(p - plane.middle_mm));
    std::vector<std::int32_t> snapped;
    for (const auto& [a, b] : edges) {
      if (off_mm_[a] * off_mm_[b] > 0) continue;
      const float share = shareOf(a, b);
      if (share <= kSnap) snapped.push_back(a);
      if (share >= 1 - kSnap) snapped.push_back(b);
    }
    for (const std::int32_t vertex : snapped) off_mm_[vertex] = 0;
  }
  bool on(std::int32_t vertex) const { return off_mm_[vertex] == 0; }
  bool crossed(std::int32_t a, std::int32_t b) const { return off_mm_[a] * off_mm_[b] < 0; }
  /// Of the way from a to b, where the plane is met.
  float shareOf(std::int32_t a, std::int32_t b) const {
    const float way = off_mm_[a] - off_mm_[b];
    return way == 0 ? 0 : off_mm_[a] / way;
  }
  void addOnPlane() { off_mm_.push_back(0); }

 private:
  std::vector<float> off_mm_;  // one a vertex
};

/// Neighbours on the plane, of each vertex on it.
using Lines = std::map<std::int32_t, std::vector<std::int32_t>>;

Lines splitAlong(SplittingMesh& mesh, const CutPlane& plane) {
  const std::set<Edge> before = edgesNear(mesh, plane);
  PlaneSides sides(mesh, plane, before);
  for (const auto& [a, b] : before)
    if (sides.crossed(a, b)) {
      mesh.split(a, b, sides.shareOf(a, b));
      sides.addOnPlane();
    }
  Lines lines;
  for (const auto& [a, b] : edgesNear(mesh, plane))
    if (sides.on(a) && sides.on(b)) {
      lines[a].push_back(b);
      lines[b].push_back(a);
    }
  return lines;
}

/// The edge of the lines that runs through the middle, its end further along last.
Edge middleEdge(const SplittingMesh& mesh, const CutPlane& plane, const Lines& lines) {
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

/// One way along the plane from the edge (from, to).
class Walk {
 public:
  Walk(SplittingMesh& mesh, const CutPlane& plane, const Lines& lines, float sign)
      : mesh_(mesh), plane_(plane), lines_(lines), sign_(sign) {}

  /// Appends vertices up to half of the length; the last one lies there, or at the vertex nearby.
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
  /// The end lies `rest_mm` along the edge, which is split there unless that is at an end of it.
  void finish(std::int32_t from, std::int32_t to, double rest_mm, CutPath& path) {
    const double share = rest_mm / length(from, to), end_mm = plane_.length_mm / 2;
    if (share >= 1 - kSnap) return append(to, end_mm, path);
    if (share > kSnap || path.vertices.empty() || path.vertices.back() != from)
      return append(mesh_.split(from, to, std::max(share, double(kSnap))), end_mm, path);
    path.along_mm.back() = sign_ * end_mm;
  }

  SplittingMesh& mesh_;
  const CutPlane& plane_;
  const Lines& lines_;
  float sign_;
};

}  // namespace

void refineAround(SplittingMesh& mesh, const CutPlane& plane, double longest_mm) {
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

CutPath layPath(SplittingMesh& mesh, const CutPlane& plane) {
  const Lines lines = splitAlong(mesh, plane);
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
