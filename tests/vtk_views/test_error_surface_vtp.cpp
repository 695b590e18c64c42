// tests/vtk_views/test_error_surface_vtp.cpp: VTK reads back what was written.
#include <gtest/gtest.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

#include "core/error.h"
#include "vtk_views/files/error_surface_vtp.h"

namespace softscope {
namespace {

TriangleMesh triangle() {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.space = "LPS";
  return mesh;
}

VertexErrors errors() {
  return {{0.5, -0.25, std::nan("")}, {0.5, 0.25, 3}, {{0, 0, -0.5f}, {0, 0, 0.25f}, {3, 0, 0}}};
}

vtkSmartPointer<vtkPolyData> readBack(const std::string& bytes) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->Update();
  return reader->GetOutput();
}

TEST(ErrorSurfaceVtp, KeepsTrianglesArraysAndSpace) {
  const auto data = readBack(errorSurfaceVtp(triangle(), errors()));
  ASSERT_EQ(data->GetNumberOfPoints(), 3);
  EXPECT_EQ(data->GetNumberOfPolys(), 1);
  EXPECT_EQ(data->GetPoint(2)[1], 2);
  vtkDataArray* signed_mm = data->GetPointData()->GetArray("Signed");
  ASSERT_NE(signed_mm, nullptr);
  EXPECT_EQ(signed_mm->GetTuple1(1), -0.25);
  EXPECT_TRUE(std::isnan(signed_mm->GetTuple1(2)));
  EXPECT_EQ(data->GetPointData()->GetArray("Absolute")->GetTuple1(2), 3);
  EXPECT_EQ(data->GetPointData()->GetArray("ToReference")->GetTuple3(2)[0], 3);
  auto* space = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SPACE"));
  ASSERT_NE(space, nullptr);
  EXPECT_EQ(space->GetValue(0), "LPS");
}

TEST(ErrorSurfaceVtp, PointsWithoutTrianglesAreVertices) {
  TriangleMesh points = triangle();
  points.triangles.clear();
  points.space.clear();
  const auto data = readBack(errorSurfaceVtp(points, errors()));
  EXPECT_EQ(data->GetNumberOfVerts(), 3);
  EXPECT_EQ(data->GetFieldData()->GetAbstractArray("SPACE"), nullptr);
}

TEST(ErrorSurfaceVtp, EveryVertexNeedsItsErrors) {
  VertexErrors lacking = errors();
  lacking.absolute_mm.pop_back();
  EXPECT_THROW(errorSurfaceVtp(triangle(), lacking), Error);
}

}  // namespace
}  // namespace softscope
