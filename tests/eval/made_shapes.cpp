// tests/eval/made_shapes.cpp: surfaces with known answers.
#include "eval/made_shapes.h"

#include <cmath>

namespace softscope {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Uniform in [0, 1), the same on every standard library.
double uniform(std::mt19937& random) { return random() / 4294967296.0; }

Eigen::Vector3f inCube(float extent_mm, std::mt19937& random) {
  Eigen::Vector3f p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = static_cast<float>((2 * uniform(random) - 1) * extent_mm);
  return p;
}

}  // namespace

TriangleMesh makeStarShape(int segments, int rings,
                           const std::function<double(const Eigen::Vector3d&)>& radius_mm) {
  TriangleMesh mesh;
  const auto add = [&](const Eigen::Vector3d& direction) {
    mesh.vertices_mm.push_back((direction * radius_mm(direction)).cast<float>());
  };
  add({0, 0, 1});
  for (int i = 1; i <= rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const double polar = kPi * i / (rings + 1), around = 2 * kPi * j / segments;
      add({std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
           std::cos(polar)});
    }
  add({0, 0, -1});
  const auto at = [&](int ring, int j) { return 1 + (ring - 1) * segments + j % segments; };
  const int last = 1 + rings * segments;
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(rings, j), last, at(rings, j + 1)});
  }
  return mesh;
}

TriangleMesh makeSphere(int segments, int rings, double radius_mm) {
  return makeStarShape(segments, rings, [=](const Eigen::Vector3d&) { return radius_mm; });
}

TriangleMesh makeOrgan(int segments, int rings) {
  return makeStarShape(segments, rings, [](const Eigen::Vector3d& d) {
    return 45 + 12 * d.x() + 8 * std::sin(3 * d.x() + 2 * d.y()) * d.z() +
           3 * std::sin(9 * d.y() + 4 * d.z()) + 0.5 * std::sin(40 * d.x()) * std::cos(35 * d.z());
  });
}

TriangleMesh makeRectangle(double width_mm, double height_mm, int columns, int rows) {
  TriangleMesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      mesh.vertices_mm.emplace_back(static_cast<float>(width_mm * x / columns),
                                    static_cast<float>(height_mm * y / rows), 0.0f);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int a = y * (columns + 1) + x, b = a + columns + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return mesh;
}

TriangleMesh makeBox(const Eigen::Vector3f& low_mm, const Eigen::Vector3f& high_mm) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_mm.emplace_back(i & 1 ? high_mm.x() : low_mm.x(),
                                  i & 2 ? high_mm.y() : low_mm.y(),
                                  i & 4 ? high_mm.z() : low_mm.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh makeSoup(int triangles, float extent_mm, float size_mm, std::mt19937& random) {
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Eigen::Vector3f centre = inCube(extent_mm, random);
    for (int k = 0; k < 3; ++k) mesh.vertices_mm.push_back(centre + inCube(size_mm, random));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

std::vector<Eigen::Vector3f> pointsNear(const TriangleMesh& mesh, int count, float reach_mm,
                                        std::mt19937& random) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
    const float a = static_cast<float>(uniform(random)), b = static_cast<float>(uniform(random));
    const float s = a + b > 1 ? 1 - a : a, r = a + b > 1 ? 1 - b : b;
    const Eigen::Vector3f& origin = mesh.vertices_mm[t[0]];
    points.push_back(origin + s * (mesh.vertices_mm[t[1]] - origin) +
                     r * (mesh.vertices_mm[t[2]] - origin) + inCube(reach_mm, random));
  }
  return points;
}

std::vector<Eigen::Vector3f> pointsInCube(int count, float extent_mm, std::mt19937& random) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.push_back(inCube(extent_mm, random));
  return points;
}

}  // namespace softscope
