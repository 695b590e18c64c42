// eval/distance/pseudo_normals.cpp: sums of normals at vertices and edges.
#include "eval/distance/pseudo_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kGrain = 4096;
constexpr double kPi = 3.14159265358979323846;

/// A triangle with a repeated index is an edge without neighbours.
bool folded(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Hash of vertex numbers to 64 bits (finaliser of splitmix64).
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

PseudoNormals::PseudoNormals(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
  vertex_normals_.resize(mesh.vertices_mm.size());
  vertex_on_border_.resize(mesh.vertices_mm.size());
  listCornersByVertex();
  computeFaces(mesh);
  sumVertices();
}

void PseudoNormals::listCornersByVertex() {
  first_corner_.assign(vertex_normals_.size() + 1, 0);
  for (const Triangle& t : triangles_)
    if (!folded(t))
      for (const std::int32_t vertex : t) ++first_corner_[vertex + 1];
  for (std::size_t v = 1; v < first_corner_.size(); ++v) first_corner_[v] += first_corner_[v - 1];
  corners_.resize(first_corner_.back());
  std::vector<std::int32_t> next(first_corner_.begin(), first_corner_.end() - 1);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (!folded(triangles_[i]))
      for (int k = 0; k < 3; ++k)
        corners_[next[triangles_[i][k]]++] = static_cast<std::int32_t>(3 * i) + k;
}

void PseudoNormals::computeFaces(const TriangleMesh& mesh) {
  face_normals_.resize(triangles_.size());
  corner_angles_rad_.resize(3 * triangles_.size());
  parallelRanges(static_cast<int>(triangles_.size()), kGrain, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector3d a = mesh.vertices_mm[triangles_[i][0]].cast<double>();
      const Eigen::Vector3d ab = mesh.vertices_mm[triangles_[i][1]].cast<double>() - a;
      const Eigen::Vector3d ac = mesh.vertices_mm[triangles_[i][2]].cast<double>() - a;
      const Eigen::Vector3d normal = ab.cross(ac);
      const double length = normal.norm();
      face_normals_[i] = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
      double* angle_rad = &corner_angles_rad_[3 * static_cast<std::size_t>(i)];
      angle_rad[0] = angleBetween(ab, ac);
      angle_rad[1] = angleBetween(ac - ab, -ab);
      angle_rad[2] = kPi - angle_rad[0] - angle_rad[1];
    }
  });
}

void PseudoNormals::sumVertices() {
  parallelRanges(static_cast<int>(vertex_normals_.size()), kGrain, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      std::uint64_t open = 0;  // 0 if outgoing edges are incoming ones, up to one chance in 2^64
      for (std::int32_t i = first_corner_[v]; i < first_corner_[v + 1]; ++i) {
        const std::int32_t triangle = corners_[i] / 3, corner = corners_[i] % 3;
        sum += corner_angles_rad_[corners_[i]] * face_normals_[triangle];
        open += mix(static_cast<std::uint64_t>(triangles_[triangle][(corner + 1) % 3])) -
                mix(static_cast<std::uint64_t>(triangles_[triangle][(corner + 2) % 3]));
      }
      vertex_normals_[v] = sum;
      vertex_on_border_[v] = open != 0;
    }
  });
}

PseudoNormals::Side PseudoNormals::ofEdge(std::int32_t from, std::int32_t to) const {
  const auto valence = [&](std::int32_t v) { return first_corner_[v + 1] - first_corner_[v]; };
  if (valence(to) < valence(from)) std::swap(from, to);
  Side side{Eigen::Vector3d::Zero(), false};
  int balance = 0;  // count of from -> to minus count of to -> from
  for (std::int32_t i = first_corner_[from]; i < first_corner_[from + 1]; ++i) {
    const std::int32_t triangle = corners_[i] / 3, corner = corners_[i] % 3;
    const bool forth = triangles_[triangle][(corner + 1) % 3] == to;
    const bool back = triangles_[triangle][(corner + 2) % 3] == to;
    if (forth || back) side.normal += face_normals_[triangle];
    balance += forth ? 1 : back ? -1 : 0;
  }
  side.on_border = balance != 0;
  return side;
}

double PseudoNormals::asideOfEdge(std::int32_t from, std::int32_t to,
                                  const Eigen::Vector3d& away_mm) const {
  double least_mm = away_mm.norm();
  for (std::int32_t i = first_corner_[from]; i < first_corner_[from + 1]; ++i) {
    const Triangle& t = triangles_[corners_[i] / 3];
    if (t[0] == to || t[1] == to || t[2] == to)
      least_mm = std::min(least_mm, away_mm.cross(face_normals_[corners_[i] / 3]).norm());
  }
  return least_mm;
}

double PseudoNormals::asideOfVertex(std::int32_t vertex, const Eigen::Vector3d& away_mm) const {
  double least_mm = away_mm.norm();
  for (std::int32_t i = first_corner_[vertex]; i < first_corner_[vertex + 1]; ++i)
    least_mm = std::min(least_mm, away_mm.cross(face_normals_[corners_[i] / 3]).norm());
  return least_mm;
}

}  // namespace softscope
