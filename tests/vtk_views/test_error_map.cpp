// tests/vtk_views/test_error_map.cpp: maps to files and back.
#include <gmock/gmock.h>

#include "core/error.h"
#include "vtk_views/files/error_map.h"
#include "vtk_views/files/error_surface_vtp.h"

namespace softscope {
namespace {

using testing::HasSubstr;

ErrorMap madeMap() {
  ErrorMap map;
  map.surface.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f}};
  map.surface.space = "LPS";
  map.absolute_mm = {0.5f, 0.25f, 1.0f};
  map.signed_mm = {-0.5f, 0.25f, std::nanf("")};
  map.observed = {1, 0, 1};
  map.reference.vertices_mm = {{0, 0, -1}, {2, 0, -1}, {0, 2, -1}};
  map.reference.triangles = {{0, 1, 2}};
  map.frame = 12;
  map.time_s = 0.48;
  map.look = {0, 0, 1};
  map.up = {0, -1, 0};
  return map;
}

TEST(ErrorMap, ComesBackFromItsFile) {
  const ErrorMap map = madeMap(), read = parseErrorMap(errorMapVtp(map), "map.vtp");
  EXPECT_EQ(read.surface.vertices_mm, map.surface.vertices_mm);
  EXPECT_TRUE(read.surface.triangles.empty()) << "points stay points";
  EXPECT_EQ(read.absolute_mm, map.absolute_mm);
  EXPECT_EQ(read.signed_mm[0], -0.5f);
  EXPECT_TRUE(std::isnan(read.signed_mm[2]));
  EXPECT_EQ(read.observed, map.observed);
  EXPECT_EQ(read.reference.vertices_mm, map.reference.vertices_mm);
  EXPECT_EQ(read.reference.triangles, map.reference.triangles);
  EXPECT_EQ(read.frame, 12);
  EXPECT_EQ(read.time_s, 0.48);
  EXPECT_EQ(read.look, map.look);
  EXPECT_EQ(read.up, map.up);
  EXPECT_EQ(read.surface.space, "LPS");
}

TEST(ErrorMap, ReadsWhatCompareWrites) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const VertexErrors errors{
      {0.1, -0.2, 0.3}, {0.1, 0.2, 0.3}, std::vector<Eigen::Vector3f>(3, Eigen::Vector3f::Zero())};
  const ErrorMap map = parseErrorMap(errorSurfaceVtp(mesh, errors), "errors.vtp");
  EXPECT_EQ(map.surface.triangles, mesh.triangles);
  EXPECT_TRUE(map.reference.vertices_mm.empty());
  EXPECT_TRUE(map.observed.empty());
  EXPECT_FLOAT_EQ(map.signed_mm[1], -0.2f);
  EXPECT_EQ(map.frame, -1);
}

TEST(ErrorMap, BrokenFilesAreRefusedByName) {
  const std::string whole = errorMapVtp(madeMap());
  for (const std::string& bytes :
       {std::string("no XML"), std::string("<?xml version=\"1.0\"?><VTKFile type=\"PolyData\">"),
        whole.substr(0, whole.size() / 2)}) {
    try {
      parseErrorMap(bytes, "broken.vtp");
      FAIL() << "read " << bytes.substr(0, 40);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("broken.vtp"));
    }
  }
  ErrorMap far = madeMap();
  far.surface.vertices_mm[1].x() = 1e30f;
  EXPECT_THROW(parseErrorMap(errorMapVtp(far), "far.vtp"), InputError);
  ErrorMap uneven = madeMap();
  uneven.signed_mm.pop_back();
  EXPECT_THROW(errorMapVtp(uneven), Error);
}

TEST(ErrorMap, ATriangleBetweenSurfaceAndReferenceIsRefused) {
  ErrorMap map = madeMap();
  map.reference.triangles = {{-1, 1, 2}};  // names a point of the surface
  EXPECT_THROW(parseErrorMap(errorMapVtp(map), "map.vtp"), InputError);
}

}  // namespace
}  // namespace softscope
