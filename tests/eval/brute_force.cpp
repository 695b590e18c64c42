// tests/eval/brute_force.cpp: every triangle, one after the other.
#include "eval/brute_force.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

struct Corners {
  Eigen::Vector3d a, b, c;
};

Corners cornersOf(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices_mm[t[0]].cast<double>(), mesh.vertices_mm[t[1]].cast<double>(),
          mesh.vertices_mm[t[2]].cast<double>()};
}

double toSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double length = (b - a).norm();
  if (length == 0) return (p - a).norm();
  const Eigen::Vector3d along = (b - a) / length;
  const double t = (p - a).dot(along);
  return (p - a - std::min(std::max(t, 0.0), length) * along).norm();
}

double toTriangle(const Eigen::Vector3d& p, const Corners& t) {
  const double edges =
      std::min({toSegment(p, t.a, t.b), toSegment(p, t.b, t.c), toSegment(p, t.c, t.a)});
  // Axes of the plane by Gram-Schmidt, twice for thin triangles; then the foot as a + s ab + t ac.
  const Eigen::Vector3d ab = t.b - t.a, ac = t.c - t.a, x = ab.normalized();
  Eigen::Vector3d y = ac - x * x.dot(ac);
  if (!(y.norm() > 0)) return edges;
  y = (y - x * x.dot(y)).normalized();
  const double along_ac = y.dot(p - t.a) / y.dot(ac);
  const double along_ab = (x.dot(p - t.a) - along_ac * x.dot(ac)) / ab.norm();
  const bool inside = along_ab >= 0 && along_ac >= 0 && along_ab + along_ac <= 1;
  return inside ? (p - t.a - along_ab * ab - along_ac * ac).norm() : edges;
}

}  // namespace

double bruteForceDistance(const TriangleMesh& mesh, const Eigen::Vector3d& point_mm) {
  double least = HUGE_VAL;
  for (const Triangle& t : mesh.triangles)
    least = std::min(least, toTriangle(point_mm, cornersOf(mesh, t)));
  return least;
}

double windingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point_mm) {
  double angle_sr = 0;
  for (const Triangle& t : mesh.triangles) {
    const Corners corners = cornersOf(mesh, t);
    const Eigen::Vector3d a = corners.a - point_mm, b = corners.b - point_mm,
                          c = corners.c - point_mm;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle_sr += 2 * std::atan2(a.dot(b.cross(c)),
                               la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle_sr / (4 * 3.14159265358979323846);
}

}  // namespace softscope
