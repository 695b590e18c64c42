// tests/vtk_views/test_vtp_surface.cpp: written files can be read; broken files are reported.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "vtk_views/files/error_surface_vtp.h"
#include "vtk_views/files/point_cloud_vtp.h"
#include "vtk_views/files/vtp_surface.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

class VtkSurface : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    files.push_back(fs::temp_directory_path() / ("softscope_" + test + name));
    std::ofstream(files.back(), std::ios::binary) << bytes;
    return files.back();
  }
  void TearDown() override {
    for (const fs::path& file : files) fs::remove(file);
  }
  std::vector<fs::path> files;
};

TEST_F(VtkSurface, AMeshWithItsSpaceComesBack) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.space = "RAS";
  const std::vector<double> zeros(4, 0.0);
  const std::vector<Eigen::Vector3f> vectors(4, Eigen::Vector3f::Zero());
  const TriangleMesh read =
      readVtkSurface(write(".vtp", errorSurfaceVtp(mesh, {zeros, zeros, vectors})));
  EXPECT_EQ(read.vertices_mm, mesh.vertices_mm);
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(read.space, "RAS");
}

TEST_F(VtkSurface, PointsComeBackAsPoints) {
  PointCloud cloud;
  cloud.points_mm = {{1, 2, 3}, {4, 5, 6}};
  const TriangleMesh read = readVtkSurface(write(".vtp", pointCloudVtp(cloud)));
  EXPECT_EQ(read.vertices_mm, cloud.points_mm);
  EXPECT_TRUE(read.triangles.empty());
}

TEST_F(VtkSurface, ALegacyFileOfQuadsIsCutIntoTriangles) {
  const TriangleMesh read =
      readVtkSurface(write(".vtk",
                           "# vtk DataFile Version 3.0\norgan SPACE=LPS\nASCII\nDATASET POLYDATA\n"
                           "POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 1 5\n4 0 1 2 3\n"));
  EXPECT_EQ(read.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read.space, "LPS");
}

TEST_F(VtkSurface, BrokenFilesAreInputErrors) {
  for (const auto& [ending, text] : std::initializer_list<std::pair<const char*, const char*>>{
           {"a.vtp", "no XML at all"},
           {"b.vtp", "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\"><PolyData></PolyData>"},
           {"c.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 9 float\n0 0"},
           {"d.vtk",
            "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
            "0 0 0 1 0 0 1 1 0\nPOLYGONS 1 4\n3 0 1 7\n"},
           {"e.vtk",
            "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\nnan 0 0\n"},
           {"f.vtk", ""}})
    EXPECT_THROW(readVtkSurface(write(ending, text)), InputError) << ending;
  EXPECT_THROW(readVtkSurface("nothing.vtp"), InputError);
}

}  // namespace
}  // namespace softscope
