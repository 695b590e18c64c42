// tests/mesh/surface_from_points_test.cpp: points of known surfaces, and what must become of them.
#include "mesh/surface_from_points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "mesh/border_trim.h"
#include "mesh/made_clouds.h"
#include "mesh/mesh_check.h"
#include "mesh/open_mesh_check.h"
#include "mesh/surface_pieces.h"

namespace softscope::test {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kSpacing_mm = 0.2;

/// Of every triangle against the normals of its vertices.
double leastCosine(const PointSurface& surface) {
  double least = 1;
  for (const Triangle& t : surface.mesh.triangles) {
    const auto at = [&](int k) { return surface.mesh.vertices_mm[std::size_t(t[std::size_t(k)])]; };
    const Eigen::Vector3f normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (const std::int32_t vertex : t)
      least = std::min(least, double(normal.dot(surface.normals[std::size_t(vertex)])));
  }
  return least;
}

void expectSound(const PointSurface& surface) {
  EXPECT_EQ(openMeshComplaint(surface.mesh), "");
  const MeshCheck check = checkMesh(surface.mesh);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.unused_vertices, 0u);
  EXPECT_GT(leastCosine(surface), 0);  // no triangle faces away from its points
}

TEST(SurfaceFromPoints, CoversASphereCapAndNothingElse) {
  const double radius_mm = 20, least_z_mm = 14;
  const PointSurface surface = surfaceFromPoints(capPoints(radius_mm, least_z_mm, kSpacing_mm));
  expectSound(surface);
  const MeshCheck check = checkMesh(surface.mesh);
  EXPECT_EQ(check.components, 1u);
  const double cap_mm2 = 2 * kPi * radius_mm * (radius_mm - least_z_mm);
  // The rim runs through the outermost points, up to a spacing inside of the cap's own.
  const double rim_mm2 = 2 * kPi * 14.3 * kSpacing_mm;
  EXPECT_LT(check.area_mm2, cap_mm2);
  EXPECT_GT(check.area_mm2, cap_mm2 - rim_mm2);
  EXPECT_LT(double(check.border_edges), 2 * 2 * kPi * 14.3 / kSpacing_mm);  // the rim alone
  // Chords of 0.35 mm at most stay this near to the sphere: 0.35² / (8 * 20).
  for (const Triangle& t : surface.mesh.triangles) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::int32_t v : t)
      centre += surface.mesh.vertices_mm[std::size_t(v)].cast<double>() / 3;
    ASSERT_NEAR(centre.norm(), radius_mm, 1e-3);
  }
}

TEST(SurfaceFromPoints, LeavesPointsColoursAndNormalsAsTheyAre) {
  const PointCloud cloud = planePoints(8, kSpacing_mm);
  const PointSurface surface = surfaceFromPoints(cloud);
  ASSERT_EQ(surface.points.size(), surface.mesh.vertices_mm.size());
  ASSERT_EQ(surface.mesh.colours.size(), surface.points.size());
  EXPECT_GT(surface.points.size(), cloud.points_mm.size() * 99 / 100);
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const auto place = std::size_t(surface.points[v]);
    ASSERT_EQ(surface.mesh.vertices_mm[v], cloud.points_mm[place]);
    ASSERT_EQ(surface.normals[v], cloud.normals[place]);
    ASSERT_EQ(surface.mesh.colours[v], cloud.colours[place]);
  }
}

TEST(SurfaceFromPoints, AHoleStaysAndAGapCloses) {
  const auto beyond = [](double radius_mm) {
    return [radius_mm](double x, double y) { return std::hypot(x - 6, y - 6) > radius_mm; };
  };
  const auto areaWithHole = [&](double radius_mm) {
    const auto keep = beyond(radius_mm);
    const PointSurface surface =
        surfaceFromPoints(planePoints(12, kSpacing_mm, 0, {0, 0, 1}, keep));
    expectSound(surface);
    return checkMesh(surface.mesh).area_mm2;
  };
  const double whole_mm2 = areaWithHole(0);
  // The border runs through points up to a spacing off the circle, on its outer side.
  const double hole_mm2 = whole_mm2 - areaWithHole(2);
  EXPECT_GT(hole_mm2, kPi * 2 * 2 * 0.98);
  EXPECT_LT(hole_mm2, kPi * 2.2 * 2.2);
  EXPECT_NEAR(areaWithHole(0.3), whole_mm2, 0.02);  // 0.6 mm wide: three spacings
}

TEST(SurfaceFromPoints, WhatAGapIsCanBeSaid) {
  const auto keep = [](double x, double y) { return std::hypot(x - 6, y - 6) > 1; };
  const PointCloud cloud = planePoints(12, kSpacing_mm, 0, {0, 0, 1}, keep);
  SurfaceOptions options;
  options.gap_mm = 3;
  const double closed_mm2 = checkMesh(surfaceFromPoints(cloud, options).mesh).area_mm2;
  options.gap_mm = 1;
  const double open_mm2 = checkMesh(surfaceFromPoints(cloud, options).mesh).area_mm2;
  EXPECT_GT(closed_mm2 - open_mm2, kPi * 0.98);
}

/// Two pieces of the whole area: neither joined nor mixed up.
void expectTwoSheets(const PointCloud& both, double each_mm2) {
  const PointSurface surface = surfaceFromPoints(both);
  expectSound(surface);
  const MeshCheck check = checkMesh(surface.mesh);
  EXPECT_EQ(check.components, 2u);
  EXPECT_NEAR(check.area_mm2, 2 * each_mm2, 0.02 * each_mm2);
}

TEST(SurfaceFromPoints, ParallelSheetsStayTwo) {
  PointCloud both = planePoints(8, kSpacing_mm);
  const double each_mm2 = checkMesh(surfaceFromPoints(both).mesh).area_mm2;
  append(both, planePoints(8, kSpacing_mm, 1.0));
  expectTwoSheets(both, each_mm2);
}

TEST(SurfaceFromPoints, LayersThatLieOnEachOtherBackToBackStayTwo) {
  PointCloud both = planePoints(8, kSpacing_mm);
  const double each_mm2 = checkMesh(surfaceFromPoints(both).mesh).area_mm2;
  append(both, planePoints(8, kSpacing_mm, -0.05, {0, 0, -1}));
  expectTwoSheets(both, each_mm2);
}

TEST(SurfaceFromPoints, DoesNotBridgeADepthEdge) {
  PointCloud both =
      planePoints(8, kSpacing_mm, 0, {0, 0, 1}, [](double x, double) { return x < 4; });
  append(both,
         planePoints(8, kSpacing_mm, 0.5, {0, 0, 1}, [](double x, double) { return x >= 4; }));
  const PointSurface surface = surfaceFromPoints(both);
  expectSound(surface);
  EXPECT_EQ(checkMesh(surface.mesh).components, 2u);
  EXPECT_LT(checkMesh(surface.mesh).area_mm2, 64);
}

TEST(SurfaceFromPoints, FollowsATightBend) {
  // A half pipe of 1 mm radius: its normals turn by 11 degrees from point to point.
  PointCloud pipe;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k <= 16; ++k) {
      const double angle = kPi * k / 16, shift = k % 2 * 0.1;
      const Eigen::Vector3d out(std::cos(angle), 0, std::sin(angle));
      pipe.points_mm.push_back((out + Eigen::Vector3d(0, 0.2 * i + shift, 0)).cast<float>());
      pipe.normals.push_back(out.cast<float>());
    }
  const PointSurface surface = surfaceFromPoints(pipe);
  expectSound(surface);
  EXPECT_EQ(checkMesh(surface.mesh).components, 1u);
  EXPECT_NEAR(checkMesh(surface.mesh).area_mm2, kPi * 7.8, 0.02 * kPi * 7.8);
}

TEST(SurfaceFromPoints, DropsIslandsAndSaysHowMany) {
  PointCloud cloud = planePoints(8, kSpacing_mm);
  const std::size_t large = surfaceFromPoints(cloud).mesh.vertices_mm.size();
  for (const float far_mm : {20.0f, 30.0f}) {
    PointCloud island = planePoints(2, kSpacing_mm);
    for (Eigen::Vector3f& p : island.points_mm) p.x() += far_mm;
    append(cloud, island);
  }
  cloud.points_mm.emplace_back(50, 50, 50);  // a lone point
  cloud.normals.emplace_back(0, 0, 1);
  cloud.colours.emplace_back();
  const PointSurface surface = surfaceFromPoints(cloud);
  EXPECT_EQ(surface.dropped_islands, 2u);
  EXPECT_EQ(surface.mesh.vertices_mm.size(), large);
  EXPECT_GE(surface.dropped_points, 201u);
  SurfaceOptions options;
  options.least_island_mm2 = 0;
  EXPECT_EQ(checkMesh(surfaceFromPoints(cloud, options).mesh).components, 3u);
}

TEST(SurfaceFromPoints, IsTheSameOnAnyNumberOfThreads) {
  const PointCloud cloud = capPoints(20, 16, kSpacing_mm);
  const PointSurface many = surfaceFromPoints(cloud);
  const ThreadLimit one_thread(1);
  const PointSurface one = surfaceFromPoints(cloud);
  EXPECT_EQ(many.mesh.triangles, one.mesh.triangles);
  EXPECT_EQ(many.points, one.points);
}

TEST(SurfaceFromPoints, TakesPointsThatLieTwiceOrNowhere) {
  PointCloud cloud = planePoints(8, kSpacing_mm);
  const PointSurface clean = surfaceFromPoints(cloud);
  append(cloud, cloud);  // each point twice
  cloud.points_mm.emplace_back(std::numeric_limits<float>::quiet_NaN(), 1, 1);
  cloud.normals.emplace_back(0, 0, 1);
  cloud.points_mm.emplace_back(1, 1, 0);
  cloud.normals.emplace_back(0, 0, 0);
  cloud.points_mm.emplace_back(1e30f, 1, 0);  // finite, and far from any cell of a grid
  cloud.normals.emplace_back(0, 0, 1);
  cloud.colours.resize(cloud.points_mm.size());
  const PointSurface surface = surfaceFromPoints(cloud);
  expectSound(surface);
  EXPECT_EQ(surface.invalid_points, 2u);
  EXPECT_EQ(surface.mesh.triangles, clean.mesh.triangles);
}

TEST(SurfaceFromPoints, TakesManyPointsInOnePlace) {
  PointCloud cloud = planePoints(12, kSpacing_mm);
  const std::size_t triangles = surfaceFromPoints(cloud).mesh.triangles.size();
  for (int i = 0; i < 8000; ++i) {  // comparing each with each would take long
    cloud.points_mm.push_back(cloud.points_mm[7]);
    cloud.normals.push_back(cloud.normals[7]);
    cloud.colours.push_back(cloud.colours[7]);
  }
  const PointSurface surface = surfaceFromPoints(cloud);
  EXPECT_GE(surface.crowded_points, 8000u);
  EXPECT_GT(surface.mesh.triangles.size(), triangles / 2);
}

TEST(SurfaceFromPoints, StaysManifoldWhateverTheNoise) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 1);
  for (const float height_mm : {0.05f, 0.2f, 1.0f}) {  // up to five spacings: no surface any more
    PointCloud cloud = planePoints(8, kSpacing_mm);
    for (std::size_t i = 0; i < cloud.points_mm.size(); ++i) {
      cloud.points_mm[i].z() += height_mm * noise(random);
      cloud.normals[i] += 0.5f * Eigen::Vector3f(noise(random), noise(random), noise(random));
      cloud.normals[i].normalize();
    }
    SurfaceOptions options;
    options.least_island_mm2 = 0;
    const PointSurface surface = surfaceFromPoints(cloud, options);
    EXPECT_EQ(openMeshComplaint(surface.mesh), "") << height_mm;
    EXPECT_TRUE(checkMesh(surface.mesh).oriented()) << height_mm;
  }
}

TEST(SurfaceFromPoints, RefusesWhatMakesNoSurface) {
  PointCloud cloud;
  EXPECT_THROW(surfaceFromPoints(cloud), InputError);
  cloud.points_mm.assign(50, {1, 2, 3});
  EXPECT_THROW(surfaceFromPoints(cloud), InputError);  // no normals
  cloud.normals.assign(50, {0, 0, 1});
  EXPECT_THROW(surfaceFromPoints(cloud), InputError);  // all in one place
  cloud.normals.assign(50, {0, 0, 0});
  EXPECT_THROW(surfaceFromPoints(cloud), InputError);
  cloud.points_mm = {{0, 0, 0}, {100, 0, 0}};
  cloud.normals.assign(2, {0, 0, 1});
  EXPECT_THROW(surfaceFromPoints(cloud), InputError);  // two points span nothing
  SurfaceOptions options;
  options.gap_spacings = 1;
  EXPECT_THROW(options.validate(), OptionError);
}

TEST(BorderTrim, CutsNeedlesAndLoneTrianglesOff) {
  // A square of two triangles, a needle on its right side with another one on that, a lone one.
  const std::vector<Eigen::Vector3f> places{{0, 0, 0},   {1, 0, 0},   {1, 1, 0},
                                            {0, 1, 0},   {9, 0.5, 0}, {17, 0.5, 0},
                                            {20, 20, 0}, {21, 20, 0}, {20, 21, 0}};
  const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}};
  std::vector<Triangle> all = square;
  for (const Triangle& t : {Triangle{1, 4, 2}, {2, 4, 5}, {6, 7, 8}}) all.push_back(t);
  EXPECT_EQ(withoutSplinters(places, all, 40), square);
  EXPECT_EQ(withoutSplinters(places, square, 40), square);  // its corners are right angles
}

TEST(SurfacePieces, APointWhereSheetsTouchBecomesAVertexOfEach) {
  const std::vector<Eigen::Vector3f> places{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  const SurfacePieces pieces = assemblePieces(places, {{0, 1, 2}, {0, 3, 4}}, 0);
  EXPECT_EQ(pieces.points, (std::vector<std::int32_t>{0, 0, 1, 2, 3, 4}));
  ASSERT_EQ(pieces.triangles.size(), 2u);
  EXPECT_NE(pieces.triangles[0][0], pieces.triangles[1][0]);
  EXPECT_EQ(assemblePieces(places, {{0, 1, 2}, {0, 3, 4}}, 0.6).dropped_pieces, 2u);
}

}  // namespace
}  // namespace softscope::test
