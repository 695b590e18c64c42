// tests/eval/brute_force.cpp: every triangle, one after the other.
#include "eval/brute_force.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
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
  Eigen::Matrix<double, 3, 2> basis;
  basis << t.b - t.a, t.c - t.a;
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 3, 2>> qr(basis);
  if (qr.rank() < 2) return edges;
  const Eigen::Vector2d foot = qr.solve(p - t.a);
  const bool inside = foot.x() >= 0 && foot.y() >= 0 && foot.sum() <= 1;
  return inside ? (p - t.a - basis * foot).norm() : edges;
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
