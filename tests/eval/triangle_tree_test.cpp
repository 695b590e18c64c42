// tests/eval/triangle_tree_test.cpp: closest points, their side, and what has no side.
#include "eval/distance/triangle_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "eval/brute_force.h"
#include "eval/made_shapes.h"

namespace softscope {
namespace {

constexpr float kNoCoordinate = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Tree and brute force both compute in double from the same floats: below 1 m they differ by
// roundings of 1e-13 m, times the conditioning of a thin triangle.
constexpr double kDoubleRounding_mm = 1e-8;

void expectBruteForceDistances(const TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& points,
                               const TreeKernels& kernels) {
  const std::vector<ClosestPoint> found = TriangleTree(mesh).closestPoints(points, kernels);
  ASSERT_EQ(found.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].cast<double>();
    EXPECT_NEAR(found[i].distance_mm, bruteForceDistance(mesh, p), kDoubleRounding_mm) << i;
    EXPECT_NEAR((found[i].point_mm - p).norm(), found[i].distance_mm, kDoubleRounding_mm) << i;
    const TriangleMesh one{mesh.vertices_mm, {mesh.triangles[found[i].triangle]}, {}, ""};
    EXPECT_NEAR(bruteForceDistance(one, found[i].point_mm), 0, kDoubleRounding_mm) << i;
  }
}

void expectSideOfWindingNumber(const TriangleMesh& mesh,
                               const std::vector<Eigen::Vector3f>& points) {
  const std::vector<ClosestPoint> found = TriangleTree(mesh).closestPoints(points);
  int inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found[i].distance_mm < 1e-5) continue;  // the winding number jumps at the surface
    const bool is_inside = windingNumber(mesh, points[i].cast<double>()) > 0.5;
    inside += is_inside;
    EXPECT_EQ(found[i].signed_distance_mm < 0, is_inside) << points[i].transpose();
    EXPECT_EQ(std::abs(found[i].signed_distance_mm), found[i].distance_mm);
  }
  EXPECT_GT(inside, 0);  // else the test compares nothing
}

ClosestPoint closest(const TriangleMesh& mesh, const Eigen::Vector3f& point) {
  return TriangleTree(mesh).closestPoints({point}).front();
}

bool sameBytes(const ClosestPoint& a, const ClosestPoint& b) {
  return a.point_mm == b.point_mm && a.distance_mm == b.distance_mm &&
         std::memcmp(&a.signed_distance_mm, &b.signed_distance_mm, sizeof(double)) == 0 &&
         a.triangle == b.triangle && a.feature == b.feature && a.on_border == b.on_border;
}

class EveryTreeKernel : public testing::TestWithParam<int> {
 protected:
  const TreeKernels& kernels() const { return *allTreeKernels().sets[GetParam()]; }
};

INSTANTIATE_TEST_SUITE_P(Sets, EveryTreeKernel, testing::Range(0, allTreeKernels().count),
                         [](const testing::TestParamInfo<int>& set) {
                           return std::string(allTreeKernels().sets[set.param]->name);
                         });

TEST_P(EveryTreeKernel, AgreesWithBruteForceNearAndFar) {
  std::mt19937 random(1);
  const TriangleMesh organ = makeOrgan(30, 20);
  expectBruteForceDistances(organ, pointsNear(organ, 200, 1, random), kernels());
  expectBruteForceDistances(organ, pointsInCube(200, 100, random), kernels());
  expectBruteForceDistances(organ, pointsInCube(50, 2000, random), kernels());
}

TEST_P(EveryTreeKernel, AgreesWithBruteForceFarFromTheOrigin) {
  std::mt19937 random(2);
  TriangleMesh organ = makeOrgan(30, 20);  // CT coordinates: half a metre from the origin
  for (Eigen::Vector3f& v : organ.vertices_mm) v += Eigen::Vector3f(-450, 380, 520);
  expectBruteForceDistances(organ, pointsNear(organ, 300, 0.5f, random), kernels());
}

TEST_P(EveryTreeKernel, AgreesWithBruteForceInASoupOfManySizes) {
  std::mt19937 random(3);
  TriangleMesh soup = makeSoup(500, 50, 0.5f, random);
  const TriangleMesh large = makeSoup(50, 50, 60, random);
  for (const Triangle& t : large.triangles) {
    for (const int vertex : t) soup.vertices_mm.push_back(large.vertices_mm[vertex]);
    const int last = static_cast<int>(soup.vertices_mm.size()) - 1;
    soup.triangles.push_back({last - 2, last - 1, last});
  }
  expectBruteForceDistances(soup, pointsInCube(300, 60, random), kernels());
}

TEST_P(EveryTreeKernel, AgreesWithBruteForceOnEveryCountAroundFullLeavesAndNodes) {
  std::mt19937 random(4);
  for (const int count : {1, 2, 7, 8, 9, 63, 64, 65, 73, 511, 512, 513}) {
    SCOPED_TRACE(count);
    const TriangleMesh soup = makeSoup(count, 20, 5, random);
    expectBruteForceDistances(soup, pointsInCube(20, 25, random), kernels());
  }
}

TEST_P(EveryTreeKernel, MeasuresDegenerateTrianglesAsSegmentsAndPoints) {
  std::mt19937 random(5);
  TriangleMesh mesh = makeSoup(40, 20, 5, random);
  for (int i = 0; i < 40; i += 2) {  // every second one: a point, a repeated corner, a segment
    Eigen::Vector3f* v = &mesh.vertices_mm[3 * static_cast<std::size_t>(i)];
    if (i % 3 == 0) v[1] = v[2] = v[0];
    if (i % 3 == 1) v[1] = v[2];
    if (i % 3 == 2) v[2] = 0.5f * (v[0] + v[1]);
  }
  expectBruteForceDistances(mesh, pointsInCube(400, 25, random), kernels());
}

TEST_P(EveryTreeKernel, MeasuresNeedlesToTheFloatsTheyAreMadeOf) {
  std::mt19937 random(6);
  TriangleMesh mesh = makeSoup(60, 20, 20, random);
  for (int i = 0; i < 60; ++i) {  // height of a millionth of the length
    Eigen::Vector3f* v = &mesh.vertices_mm[3 * static_cast<std::size_t>(i)];
    v[2] = 0.3f * v[0] + 0.7f * v[1] + pointsInCube(1, 2e-5f, random).front();
  }
  expectBruteForceDistances(mesh, pointsNear(mesh, 400, 0.1f, random), kernels());
}

TEST_P(EveryTreeKernel, GivesTheLowestOfManyEquallyCloseTriangles) {
  // The octahedron's centre is as far from all faces, bit by bit, and 300 copies of each overfill
  // the list of candidates.
  TriangleMesh mesh;
  mesh.vertices_mm = {{9, 0, 0}, {-9, 0, 0}, {0, 9, 0}, {0, -9, 0}, {0, 0, 9}, {0, 0, -9}};
  for (int copy = 0; copy < 300; ++copy)
    for (const Triangle& t :
         {Triangle{0, 2, 4}, Triangle{2, 1, 4}, Triangle{1, 3, 4}, Triangle{3, 0, 4},
          Triangle{2, 0, 5}, Triangle{1, 2, 5}, Triangle{3, 1, 5}, Triangle{0, 3, 5}})
      mesh.triangles.push_back(t);
  const std::vector<ClosestPoint> found =
      TriangleTree(mesh).closestPoints({{0, 0, 0}, {2, 2, 2}, {-9, 0, 0}}, kernels());
  EXPECT_EQ(found[0].triangle, 0);
  EXPECT_NEAR(found[0].signed_distance_mm, -std::sqrt(27.0), 1e-12);
  EXPECT_EQ(found[1].triangle, 0);
  EXPECT_EQ(found[2].triangle, 1);
  EXPECT_EQ(found[2].distance_mm, 0);
}

TEST_P(EveryTreeKernel, AnswersAlikeOnAnyNumberOfThreadsAndInAnyOrder) {
  std::mt19937 random(7);
  const TriangleMesh organ = makeOrgan(60, 50);
  std::vector<Eigen::Vector3f> points = pointsNear(organ, 5000, 10, random);
  const TriangleTree tree(organ);
  const std::vector<ClosestPoint> expected = [&] {
    const ThreadLimit one(1);
    return tree.closestPoints(points, *allTreeKernels().sets[0]);
  }();
  std::vector<std::size_t> shuffled(points.size());
  for (std::size_t i = 0; i < shuffled.size(); ++i) shuffled[i] = i;
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  std::vector<Eigen::Vector3f> others;
  for (const std::size_t i : shuffled) others.push_back(points[i]);

  const ThreadLimit four(4);
  const std::vector<ClosestPoint> found = tree.closestPoints(others, kernels());
  for (std::size_t i = 0; i < shuffled.size(); ++i)
    ASSERT_TRUE(sameBytes(found[i], expected[shuffled[i]])) << i;
}

TEST(TriangleTree, KnowsInsideFromOutsideAsTheWindingNumberDoes) {
  std::mt19937 random(8);
  const TriangleMesh organ = makeOrgan(30, 20);
  expectSideOfWindingNumber(organ, pointsNear(organ, 300, 2, random));
  expectSideOfWindingNumber(organ, pointsInCube(300, 70, random));
}

TEST(TriangleTree, KnowsTheSideAmongSharpSpikes) {
  std::mt19937 random(9);
  const TriangleMesh spikes = makeStarShape(16, 11, [&](const Eigen::Vector3d& d) {
    return std::sin(40 * d.x() + 23 * d.y() + 31 * d.z()) > 0.3 ? 60.0 : 8.0;
  });
  expectSideOfWindingNumber(spikes, pointsNear(spikes, 1000, 3, random));
  expectSideOfWindingNumber(spikes, pointsInCube(1000, 60, random));
}

TEST(TriangleTree, TakesNoFaceForTheWholeTip) {
  // A thin blade ending in a tip. From the query the tip is closest, and the query is behind
  // the plane of one of its faces: the normal of that face alone would give "inside".
  TriangleMesh blade;
  blade.vertices_mm = {{0, 0, 0}, {-10, 1, 0}, {-10, -1, 0}, {-10, 0, 1}};
  blade.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const Eigen::Vector3f query(1, 0.02f, 1);
  const TriangleTree tree(blade);
  const ClosestPoint found = tree.closestPoints({query}).front();
  double least = 1;
  for (int i = 0; i < 3; ++i) least = std::min(least, tree.faceNormal(i).dot(query.cast<double>()));
  ASSERT_LT(least, 0);  // the trap is one
  EXPECT_EQ(found.feature, SurfaceFeature::kVertex);
  EXPECT_NEAR(found.signed_distance_mm, query.cast<double>().norm(), 1e-12);
}

TEST(TriangleTree, WeighsNormalsByAngleNotByCount) {
  // A cube's corner with one of its three faces cut into a fan of forty: counted, not weighed, the
  // fan would outvote the others. The point is outside the pit of the inverted cube's corner.
  TriangleMesh corner;
  corner.vertices_mm = {{0, 0, 0}, {0, 0, 10}};
  constexpr int kFan = 40;
  for (int i = 0; i <= kFan; ++i) {
    const double angle_rad = 1.5707963267948966 * i / kFan;
    corner.vertices_mm.emplace_back(static_cast<float>(10 * std::cos(angle_rad)),
                                    static_cast<float>(10 * std::sin(angle_rad)), 0.0f);
  }
  for (int i = 0; i < kFan; ++i) corner.triangles.push_back({0, 3 + i, 2 + i});
  corner.triangles.push_back({0, 1, 2 + kFan});  // x = 0
  corner.triangles.push_back({0, 2, 1});         // y = 0
  const Eigen::Vector3f query(-3, -3, 0.5f);
  const ClosestPoint found = closest(corner, query);
  EXPECT_EQ(found.feature, SurfaceFeature::kEdge);  // the z axis, in front of the query
  EXPECT_GT(found.signed_distance_mm, 0);
  const PseudoNormals::Side side = PseudoNormals(corner).ofVertex(0);
  EXPECT_FALSE(side.on_border);
  const Eigen::Vector3d diagonal = Eigen::Vector3d(-1, -1, -1).normalized();
  EXPECT_NEAR((side.normal.normalized() - diagonal).norm(), 0, 1e-6);  // float vertices
}

TEST(TriangleTree, NamesTheFeatureOfASingleTriangle) {
  TriangleMesh one;
  one.vertices_mm = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  one.triangles = {{0, 1, 2}};
  const ClosestPoint above = closest(one, {1, 1, 3});
  EXPECT_EQ(above.feature, SurfaceFeature::kFace);
  EXPECT_EQ(above.signed_distance_mm, 3);
  EXPECT_FALSE(above.on_border);
  EXPECT_EQ(closest(one, {1, 1, -3}).signed_distance_mm, -3);

  const ClosestPoint beside = closest(one, {2, -3, 4});
  EXPECT_EQ(beside.feature, SurfaceFeature::kEdge);
  EXPECT_EQ(beside.distance_mm, 5);
  EXPECT_TRUE(beside.on_border);
  EXPECT_TRUE(std::isnan(beside.signed_distance_mm));

  const ClosestPoint beyond = closest(one, {-3, -4, 0});
  EXPECT_EQ(beyond.feature, SurfaceFeature::kVertex);
  EXPECT_EQ(beyond.distance_mm, 5);
  EXPECT_TRUE(beyond.on_border);
  EXPECT_TRUE(std::isnan(beyond.signed_distance_mm));
}

TEST(TriangleTree, HasNoSideBeyondTheBorderOfAnOpenPatch) {
  const TriangleTree patch(makeRectangle(10, 10, 5, 5));
  std::mt19937 random(10);
  for (const Eigen::Vector3f& p : pointsInCube(500, 20, random)) {
    const ClosestPoint found = patch.closestPoints({p}).front();
    const bool over_the_patch = p.x() > 0 && p.x() < 10 && p.y() > 0 && p.y() < 10;
    EXPECT_EQ(found.on_border, !over_the_patch);
    EXPECT_EQ(std::isnan(found.signed_distance_mm), !over_the_patch);
    if (!over_the_patch) continue;
    EXPECT_NEAR(found.signed_distance_mm, p.z(), 1e-12);
  }
}

TEST(TriangleTree, KnowsTheSideOverInnerEdgesAndVerticesOfAnOpenPatch) {
  const TriangleMesh patch = makeRectangle(10, 10, 5, 5);
  const ClosestPoint vertex = closest(patch, {4, 6, -2});
  EXPECT_EQ(vertex.feature, SurfaceFeature::kVertex);
  EXPECT_EQ(vertex.signed_distance_mm, -2);
  const ClosestPoint edge = closest(patch, {4, 5, 3});
  EXPECT_EQ(edge.feature, SurfaceFeature::kEdge);
  EXPECT_EQ(edge.signed_distance_mm, 3);
}

TEST(TriangleTree, HasNoSideWhereNeighboursDisagree) {
  TriangleMesh patch = makeRectangle(10, 10, 5, 5);
  std::swap(patch.triangles[24][1], patch.triangles[24][2]);  // column 2, row 2, lower half
  const ClosestPoint at_its_edge = closest(patch, {5, 4, 1});
  EXPECT_EQ(at_its_edge.feature, SurfaceFeature::kEdge);
  EXPECT_TRUE(std::isnan(at_its_edge.signed_distance_mm));
  EXPECT_EQ(closest(patch, {4.2f, 2.1f, 1}).signed_distance_mm, 1);  // a neighbour's face
}

TEST(TriangleTree, KeepsTheSideWhereTrianglesWithoutAreaLie) {
  TriangleMesh box = makeBox({-5, -5, -5}, {5, 5, 5});
  box.triangles.push_back({0, 0, 1});  // folded along an edge
  box.triangles.push_back({3, 3, 3});
  std::mt19937 random(11);
  expectSideOfWindingNumber(box, pointsInCube(500, 8, random));
}

TEST(TriangleTree, KeepsTheSideAcrossASeamOfFlatTriangles) {
  // Two triangles meet the long edge's one through a triangle whose corners lie on one line.
  TriangleMesh roof;
  roof.vertices_mm = {{-4, 0, 0}, {4, 0, 0}, {0, 0, 0}, {0, 5, -1}, {0, -5, -1}};
  roof.triangles = {{0, 1, 3}, {0, 4, 2}, {2, 4, 1}, {0, 2, 1}};
  for (const float x : {-2.0f, 0.0f, 1.0f}) {
    const ClosestPoint above = closest(roof, {x, 0, 2});
    EXPECT_FALSE(above.on_border);
    EXPECT_NEAR(above.signed_distance_mm, 2, 1e-12) << x;
  }
}

TEST(TriangleTree, LeavesPointsThatAreNotFiniteWithoutAnswer) {
  const TriangleTree tree(makeSphere(12, 7, 10));
  const std::vector<ClosestPoint> found = tree.closestPoints(
      {{0, kNoCoordinate, 0}, {20, 0, 0}, {kInfinity, 0, 0}, {0, 0, -kInfinity}, {1e30f, 0, 0}});
  for (const std::size_t i : {0, 2, 3, 4}) {
    EXPECT_TRUE(std::isnan(found[i].distance_mm)) << i;
    EXPECT_TRUE(std::isnan(found[i].signed_distance_mm)) << i;
    EXPECT_EQ(found[i].triangle, -1) << i;
    EXPECT_EQ(found[i].feature, SurfaceFeature::kNone) << i;
  }
  EXPECT_NEAR(found[1].signed_distance_mm, 10, 1e-5);  // (10, 0, 0) is a vertex, in float
  EXPECT_TRUE(tree.closestPoints({}).empty());
}

TEST(TriangleTree, RefusesWhatIsNoSurface) {
  TriangleMesh mesh;
  EXPECT_THROW(TriangleTree{mesh}, InputError);
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THROW(TriangleTree{mesh}, InputError);
  mesh.triangles = {{0, 1, 3}};
  EXPECT_THROW(TriangleTree{mesh}, InputError);
  mesh.triangles = {{0, 1, -1}};
  EXPECT_THROW(TriangleTree{mesh}, InputError);
  mesh.triangles = {{0, 1, 2}};
  EXPECT_NO_THROW(TriangleTree{mesh});
  mesh.vertices_mm[1].y() = kNoCoordinate;
  EXPECT_THROW(TriangleTree{mesh}, InputError);
  mesh.vertices_mm[1].y() = 2e6f;
  EXPECT_THROW(TriangleTree{mesh}, InputError);
}

}  // namespace
}  // namespace softscope
