// tests/mesh/mesh_check_test.cpp: surfaces whose faults were put in.
#include "mesh/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "eval/made_shapes.h"

namespace softscope {
namespace {

constexpr double kRounding = 1e-9;  // sums in double of vertices that float holds exactly

TriangleMesh joined(TriangleMesh first, const TriangleMesh& second) {
  const int offset = static_cast<int>(first.vertices_mm.size());
  for (const Eigen::Vector3f& v : second.vertices_mm) first.vertices_mm.push_back(v);
  for (const Triangle& t : second.triangles)
    first.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return first;
}

/// Makes `second` the same vertex as `first`.
void weld(TriangleMesh& mesh, int first, int second) {
  for (Triangle& t : mesh.triangles)
    for (std::int32_t& vertex : t)
      if (vertex == second) vertex = first;
}

TEST(MeshCheck, MeasuresABox) {
  const MeshCheck box = checkMesh(makeBox({100, 200, 300}, {110, 220, 340}));
  EXPECT_TRUE(box.closed());
  EXPECT_TRUE(box.manifold());
  EXPECT_TRUE(box.oriented());
  EXPECT_EQ(box.components, 1u);
  EXPECT_EQ(box.size_mm(), Eigen::Vector3f(10, 20, 40));
  EXPECT_NEAR(box.area_mm2, 2 * (10 * 20 + 20 * 40 + 40 * 10), kRounding);
  EXPECT_NEAR(box.volume_mm3, 10 * 20 * 40, kRounding);
  EXPECT_EQ(box.degenerate_triangles, 0u);
  EXPECT_EQ(box.unused_vertices, 0u);
  EXPECT_EQ(box.likely_unit_mm, 1);
  EXPECT_TRUE(meshWarnings(box).empty());
}

TEST(MeshCheck, MeasuresASphere) {
  const double pi = 3.14159265358979;
  const MeshCheck sphere = checkMesh(makeSphere(200, 99, 30));
  EXPECT_TRUE(sphere.closed() && sphere.manifold() && sphere.oriented());
  // An inscribed polyhedron with steps of h = pi / 100 misses the sphere by about h² / 3.
  EXPECT_NEAR(sphere.volume_mm3 / (4.0 / 3 * pi * 27000), 1, 5e-4);
  EXPECT_NEAR(sphere.area_mm2 / (4 * pi * 900), 1, 5e-4);
}

TEST(MeshCheck, FindsTheBorderOfAnOpenPatch) {
  const MeshCheck patch = checkMesh(makeRectangle(10, 20, 5, 7));
  EXPECT_FALSE(patch.closed());
  EXPECT_EQ(patch.border_edges, 24u);
  EXPECT_TRUE(patch.manifold());
  EXPECT_TRUE(patch.oriented());
  EXPECT_TRUE(std::isnan(patch.volume_mm3));  // no plausible number for what has none
  EXPECT_NEAR(patch.area_mm2, 200, 1e-4);     // vertices at sevenths, in float
  EXPECT_EQ(meshWarnings(patch).size(), 1u);
}

TEST(MeshCheck, FindsATriangleThatFacesTheWrongWay) {
  TriangleMesh box = makeBox({0, 0, 0}, {10, 10, 10});
  std::swap(box.triangles[3][0], box.triangles[3][1]);
  const MeshCheck check = checkMesh(box);
  EXPECT_TRUE(check.closed());
  EXPECT_FALSE(check.oriented());
  EXPECT_EQ(check.flipped_edges, 3u);
  EXPECT_TRUE(std::isnan(check.volume_mm3));
}

TEST(MeshCheck, FindsASurfaceThatIsInsideOut) {
  TriangleMesh box = makeBox({0, 0, 0}, {10, 10, 10});
  for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(checkMesh(box).volume_mm3, -1000, kRounding);
  EXPECT_EQ(meshWarnings(checkMesh(box)).size(), 1u);
}

TEST(MeshCheck, CountsPiecesAndVerticesWhereTheyTouch) {
  TriangleMesh two = joined(makeBox({0, 0, 0}, {10, 10, 10}), makeBox({10, 10, 10}, {20, 20, 20}));
  EXPECT_EQ(checkMesh(two).components, 2u);
  EXPECT_EQ(checkMesh(two).split_vertices, 0u);
  weld(two, 7, 8);  // the corner (10, 10, 10) of both
  const MeshCheck touching = checkMesh(two);
  EXPECT_EQ(touching.components, 1u);
  EXPECT_EQ(touching.split_vertices, 1u);
  EXPECT_EQ(touching.unused_vertices, 1u);
  EXPECT_FALSE(touching.manifold());
  EXPECT_TRUE(touching.closed());
}

TEST(MeshCheck, FindsEdgesOfMoreThanTwoTriangles) {
  TriangleMesh book = makeRectangle(10, 10, 1, 1);  // a third page on the diagonal
  book.vertices_mm.emplace_back(5, 5, 5);
  book.triangles.push_back({0, 3, 4});
  const MeshCheck check = checkMesh(book);
  EXPECT_EQ(check.crowded_edges, 1u);
  EXPECT_FALSE(check.manifold());
}

TEST(MeshCheck, FindsTrianglesWithoutArea) {
  TriangleMesh mesh = makeBox({0, 0, 0}, {10, 10, 10});
  mesh.vertices_mm.emplace_back(5, 0, 0);
  mesh.triangles.push_back({0, 1, 8});  // on one line
  mesh.triangles.push_back({2, 2, 3});  // twice the same vertex
  EXPECT_EQ(checkMesh(mesh).degenerate_triangles, 2u);
}

TEST(MeshCheck, GuessesTheUnitFromTheBox) {
  const auto unitOf = [](float side) {
    return checkMesh(makeBox({0, 0, 0}, {side / 2, side / 3, side})).likely_unit_mm;
  };
  EXPECT_EQ(unitOf(120), 1);
  EXPECT_EQ(unitOf(0.12f), 1000);
  EXPECT_EQ(unitOf(120000), 0.001);
  EXPECT_EQ(unitOf(1e-5f), 1);  // no unit makes an organ of it: no guess
  EXPECT_NE(meshWarnings(checkMesh(makeBox({0, 0, 0}, {0.1f, 0.1f, 0.12f}))).at(0).find("metres"),
            std::string::npos);
}

TEST(MeshCheck, OfNothingIsNotClosed) {
  const MeshCheck check = checkMesh(TriangleMesh{});
  EXPECT_FALSE(check.closed());
  EXPECT_EQ(check.components, 0u);
}

}  // namespace
}  // namespace softscope
