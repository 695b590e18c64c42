// tests/mesh/development_data_test.cpp: organs and CT surfaces, read as OpenMesh reads them.
#include <gtest/gtest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cmath>

#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

/// Both merge equal corners in order of appearance, so that vertex i is vertex i.
void expectAsOpenMesh(const std::filesystem::path& file) {
  SCOPED_TRACE(file.filename());
  const TriangleMesh mesh = readMesh(file);
  OpenMesh::TriMesh_ArrayKernelT<> other;
  testing::internal::CaptureStderr();  // it doesn't know VTK's header lines, and says so
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

}  // namespace
}  // namespace softscope::test
