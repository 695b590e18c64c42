#include "mesh/coarse_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.h"

namespace softscope {
namespace {

TriangleMesh gridMesh(int side) {
  TriangleMesh mesh;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      mesh.vertices_mm.emplace_back(float(i), float(j), 0.1f * float(i * j % 7));
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const int a = j * side + i;
      mesh.triangles.push_back({a, a + 1, a + side + 1});
      mesh.triangles.push_back({a, a + side + 1, a + side});
    }
  return mesh;
}

TEST(CoarseMesh, KeepsVerticesOfItsOwnWithinTheLimitAndCoversTheSurface) {
  const TriangleMesh fine = gridMesh(60);
  const CoarseMesh coarse = coarsen(fine, 400);
  EXPECT_LE(coarse.vertices.size(), 400u);
  EXPECT_GE(coarse.vertices.size(), 100u) << "far fewer than asked for would show no shape";
  EXPECT_TRUE(std::is_sorted(coarse.vertices.begin(), coarse.vertices.end()));
  const TriangleMesh mesh = coarse.at(fine.vertices_mm);
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](int k) { return mesh.vertices_mm.at(std::size_t(t[std::size_t(k)])); };
    area += 0.5 * double((corner(1) - corner(0)).cross(corner(2) - corner(0)).norm());
  }
  EXPECT_NEAR(area, 59.0 * 59, 0.25 * 59 * 59);  // the rim moves in by half a cell; bumps add some
}

TEST(CoarseMesh, ASmallMeshStaysAsItIs) {
  const TriangleMesh fine = gridMesh(5);
  const CoarseMesh coarse = coarsen(fine, 25);
  EXPECT_EQ(coarse.triangles, fine.triangles);
  EXPECT_EQ(coarse.at(fine.vertices_mm).vertices_mm, fine.vertices_mm);
}

TEST(CoarseMesh, FollowsTheFineMeshWhenThatMoves) {
  const TriangleMesh fine = gridMesh(20);
  const CoarseMesh coarse = coarsen(fine, 50);
  std::vector<Eigen::Vector3f> moved = fine.vertices_mm;
  for (Eigen::Vector3f& p : moved) p.z() += 5;
  const TriangleMesh before = coarse.at(fine.vertices_mm), after = coarse.at(moved);
  for (std::size_t i = 0; i < before.vertices_mm.size(); ++i)
    EXPECT_EQ(after.vertices_mm[i].z(), before.vertices_mm[i].z() + 5);
  EXPECT_THROW(coarsen(fine, 0), OptionError);
}

TEST(CoarseMesh, PointsInOnePlaceBecomeOne) {
  TriangleMesh heap;
  heap.vertices_mm.assign(10, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(coarsen(heap, 4).vertices.size(), 1u);
}

}  // namespace
}  // namespace softscope
