// tests/eval/development_data_test.cpp: distances and alignment on organs and a CT patch.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "eval/brute_force.h"
#include "eval/distance/triangle_tree.h"
#include "eval/made_shapes.h"
#include "eval/surfaces/surface_alignment.h"
#include "mesh/mesh_reader.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

TEST(DevelopmentData, DistancesToOrgansAreThoseOfBruteForce) {
  SOFTSCOPE_DATA_OR_SKIP(data, "openhelp");
  for (const char* organ : {"Heart.stl", "Liver.stl", "Kidney_right.stl"}) {
    const TriangleMesh mesh = readMesh(data / organ);
    std::mt19937 random(1);
    const auto points = pointsNear(mesh, 40, 3, random);
    const auto found = TriangleTree(mesh).closestPoints(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d p = points[i].cast<double>();
      EXPECT_NEAR(found[i].distance_mm, bruteForceDistance(mesh, p), 1e-8);  // both in double
      EXPECT_EQ(found[i].signed_distance_mm<0, windingNumber(mesh, p)> 0.5);
    }
  }
}

TEST(DevelopmentData, APatchOfCtThatWasMovedComesBack) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  const TriangleMesh patch = readMesh(data / "Stereo_SD_d_complete_22_CT_cut.stl");
  std::mt19937 random(2);
  const auto points = pointsNear(patch, 5000, 0.05f, random);  // a scan's noise
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : points) centre += p.cast<double>() / 5000;
  const Eigen::Isometry3d displaced =
      Eigen::Translation3d(centre + Eigen::Vector3d(0.4, -0.3, 0.5)) *
      Eigen::AngleAxisd(0.03, Eigen::Vector3d(1, 2, -1).normalized()) *
      Eigen::Translation3d(-centre);

  const SurfaceAlignment found = alignToSurface(movePoints(displaced, points), TriangleTree(patch));

  EXPECT_TRUE(found.converged());
  EXPECT_EQ(found.free_directions, 0);
  EXPECT_GT(found.before.distance_mm.mean, 0.3);
  EXPECT_LT(found.after.distance_mm.mean, 0.03);  // uniform in a cube of ± 0.05: 0.025 to a plane
  EXPECT_LT((found.surface_from_points * displaced * centre - centre).norm(), 0.02);
}

}  // namespace
}  // namespace softscope::test
