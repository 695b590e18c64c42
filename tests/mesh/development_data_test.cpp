// tests/mesh/development_data_test.cpp: organs and CT surfaces, read as OpenMesh reads them.
#include <gtest/gtest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cmath>

#include "eval/distance/triangle_tree.h"
#include "eval/statistics/statistics.h"
#include "io/calibrations/calibration_reader.h"
#include "io/geometry/depth_files.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "mesh/open_mesh_check.h"
#include "mesh/surface_from_points.h"
#include "stereo/depth/depth_from_disparity.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

/// Both merge equal corners in order of appearance, so that vertex i is vertex i.
void expectAsOpenMesh(const std::filesystem::path& file) {
  SCOPED_TRACE(file.filename());
  const TriangleMesh mesh = readMesh(file);
  OpenMesh::TriMesh_ArrayKernelT<> other;
  testing::internal::CaptureStderr();  // it warns of unknown header lines of VTK
  const bool read = OpenMesh::IO::read_mesh(other, file.string());
  testing::internal::GetCapturedStderr();
  ASSERT_TRUE(read);
  ASSERT_EQ(mesh.vertices_mm.size(), other.n_vertices());
  ASSERT_EQ(mesh.triangles.size(), other.n_faces());
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const auto& p = other.point(other.vertex_handle(static_cast<unsigned>(i)));
    ASSERT_EQ(mesh.vertices_mm[i], Eigen::Vector3f(p[0], p[1], p[2])) << i;
  }
}

TEST(DevelopmentData, OrgansAreClosedAndInMillimetres) {
  SOFTSCOPE_DATA_OR_SKIP(data, "openhelp");
  for (const char* organ : {"Heart.stl", "Liver.stl", "Kidney_right.stl"}) {
    expectAsOpenMesh(data / organ);
    const MeshCheck check = checkMesh(readMesh(data / organ));
    EXPECT_TRUE(check.closed() && check.manifold() && check.oriented()) << organ;
    EXPECT_EQ(check.components, 1u);
    EXPECT_EQ(check.likely_unit_mm, 1);
    EXPECT_GT(check.volume_mm3, 1e5);  // a tenth of a litre
  }
}

TEST(DevelopmentData, CtSurfacesOfPlyFilesAreClosed) {
  SOFTSCOPE_DATA_OR_SKIP(data, "ct");
  for (const char* organ : {"chaos_set3_liver_LPSmm.ply", "totalseg_heart_1p5mm_LPS.ply",
                            "totalseg_example_kidney_right_3mm_LPS.ply"}) {
    expectAsOpenMesh(data / organ);
    EXPECT_TRUE(meshWarnings(checkMesh(readMesh(data / organ))).empty()) << organ;
  }
}

TEST(DevelopmentData, TheCtPatchOfOpenCasIsOpen) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  const auto file = data / "Stereo_SD_d_complete_22_CT_cut.stl";
  expectAsOpenMesh(file);
  const MeshCheck check = checkMesh(readMesh(file));
  EXPECT_FALSE(check.closed());
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.components, 1u);
  EXPECT_TRUE(std::isnan(check.volume_mm3));
}

std::vector<Eigen::Vector3f> triangleCentres(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> centres;
  for (const Triangle& t : mesh.triangles) {
    centres.emplace_back(0, 0, 0);
    for (const std::int32_t v : t) centres.back() += mesh.vertices_mm[std::size_t(v)] / 3;
  }
  return centres;
}

Statistics distancesFrom(const TriangleTree& truth, const std::vector<Eigen::Vector3f>& points_mm) {
  std::vector<double> distances_mm;
  for (const ClosestPoint& closest : truth.closestPoints(points_mm))
    distances_mm.push_back(closest.distance_mm);
  return statistics(distances_mm);
}

/// Every third pixel of every third row: points 0.3 mm apart, as in a model that was stretched.
PointCloud pointsOfTrueDepth(const std::filesystem::path& sequence) {
  const PinholeCamera camera = readCalibration(sequence).left.pinhole;
  const Raster<float> depth_mm = readDepth(sequence / "groundtruth/depth/000000.png");
  Mask mask(depth_mm.width_px, depth_mm.height_px, 1);
  for (int v = 0; v < mask.height_px; v += 3)
    for (int u = 0; u < mask.width_px; u += 3) mask.at(u, v) = 0;
  const ColourImage colour(depth_mm.width_px, depth_mm.height_px);
  return pointCloud(depth_mm, normalsFromDepth(depth_mm, camera), colour, camera, mask);
}

TEST(DevelopmentData, TheSurfaceOfAnOrgansDepthIsAsTrueAsItsPoints) {
  SOFTSCOPE_DATA_OR_SKIP(data, "openhelp_heart");
  const PointCloud cloud = pointsOfTrueDepth(data);
  const PointSurface surface = surfaceFromPoints(cloud);
  EXPECT_EQ(openMeshComplaint(surface.mesh), "");
  EXPECT_TRUE(checkMesh(surface.mesh).oriented());
  EXPECT_GT(surface.points.size(), cloud.points_mm.size() * 99 / 100);
  const TriangleTree truth(readMesh(data / "groundtruth/mesh/000000.ply"));
  const Statistics points = distancesFrom(truth, cloud.points_mm);
  const Statistics triangles = distancesFrom(truth, triangleCentres(surface.mesh));
  constexpr double kChord_mm = 0.002;  // a triangle 0.35 mm wide over a bend of 8 mm radius
  EXPECT_LE(triangles.mean, points.mean + kChord_mm);
  EXPECT_LE(triangles.p95, points.p95 + kChord_mm);
}

}  // namespace
}  // namespace softscope::test
