// tests/simulation/ray_tree_test.cpp: ray hits agree with formulas.
#include "eval/simulation/surface/ray_tree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "eval/simulation/noise/random.h"
#include "simple_shapes.h"

namespace softscope {
namespace {

TEST(RayTree, MeetsASphereWhereTheFormulaSays) {
  const TriangleMesh sphere = test::makeSphere(20, 80);
  const RayTree tree(sphere.vertices_mm, sphere.triangles);
  SeededRandom random(4);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f from = 60 * random.direction().cast<float>();
    const Eigen::Vector3f to = 12 * random.direction().cast<float>();
    const Eigen::Vector3f d = (to - from).normalized();
    const float b = from.dot(d), c = from.squaredNorm() - 400;
    const RayHit hit = tree.cast(from, d);
    ASSERT_TRUE(hit.met());
    // Triangles of 0.4 mm (circumradius 0.28) lie at most 0.28^2 / (2 * 20) = 0.002 mm below the
    // sphere; seen aslant by up to 37 degrees that is 0.0025 mm.
    EXPECT_NEAR(hit.distance, -b - std::sqrt(b * b - c), 0.003);
  }
}

TEST(RayTree, AgreesWithTryingEveryTriangle) {
  const TriangleMesh organ = makeOrganMesh({60, 12, 3, 1.4}, 5);
  const RayTree tree(organ.vertices_mm, organ.triangles);
  std::vector<RayTree> single;
  for (const Triangle& t : organ.triangles)
    single.emplace_back(std::vector<Eigen::Vector3f>(organ.vertices_mm), std::vector<Triangle>{t});
  SeededRandom random(9);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f from = 50 * random.direction().cast<float>();
    const Eigen::Vector3f d = (30 * random.direction().cast<float>() - from).normalized();
    float nearest = std::numeric_limits<float>::infinity();
    for (const RayTree& one : single)
      if (const RayHit hit = one.cast(from, d); hit.met())
        nearest = std::min(nearest, hit.distance);
    const RayHit hit = tree.cast(from, d);
    ASSERT_EQ(hit.met(), std::isfinite(nearest));
    if (!hit.met()) continue;
    EXPECT_EQ(hit.distance, nearest);  // the same arithmetic, so the same bits
    ++met;
  }
  EXPECT_GT(met, 100);  // else the test tests nothing
}

TEST(RayTree, LeavesNoHoleAlongEdges) {
  const TriangleMesh sphere = test::makeSphere(20, 10);
  const RayTree tree(sphere.vertices_mm, sphere.triangles);
  const Eigen::Vector3f eye(0.3F, -0.2F, 60);
  for (const Triangle& t : sphere.triangles)
    for (int side = 0; side < 3; ++side) {
      const Eigen::Vector3f &a = sphere.vertices_mm[t[side]],
                            &b = sphere.vertices_mm[t[(side + 1) % 3]];
      for (const float share : {0.0F, 0.25F, 0.5F, 0.77F}) {
        const Eigen::Vector3f p = a + share * (b - a);
        if (p.z() < 10) continue;  // clear of the silhouette
        EXPECT_TRUE(tree.cast(eye, p - eye).met());
      }
    }
}

TEST(RayTree, TakesAxisParallelRays) {
  const TriangleMesh square = test::makeSquare(10);
  const RayTree tree(square.vertices_mm, square.triangles);
  const RayHit hit = tree.cast({1, 1, 7}, {0, 0, -1});
  ASSERT_TRUE(hit.met());
  EXPECT_EQ(hit.distance, 7);
  EXPECT_FALSE(tree.cast({1, 1, 7}, {0, 0, 1}).met());   // behind
  EXPECT_FALSE(tree.cast({6, 1, 7}, {0, 0, -1}).met());  // next to it
}

TEST(RayTree, RefusesWhatIsNoSurface) {
  TriangleMesh square = test::makeSquare(10);
  EXPECT_THROW(RayTree(square.vertices_mm, {}), InputError);
  EXPECT_THROW(RayTree(square.vertices_mm, {{0, 1, 4}}), InputError);
  EXPECT_THROW(RayTree(square.vertices_mm, {{0, -1, 2}}), InputError);
  square.vertices_mm[1].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(RayTree(square.vertices_mm, square.triangles), InputError);
}

}  // namespace
}  // namespace softscope
