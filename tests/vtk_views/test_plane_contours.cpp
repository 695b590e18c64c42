// tests/vtk_views/test_plane_contours.cpp: cuts through shapes whose outlines are known.
#include <gtest/gtest.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <cmath>

#include "vtk_views/scenes/clip_line.h"
#include "vtk_views/scenes/plane_contours.h"

namespace softscope {
namespace {

TriangleMesh sphere(int resolution) {
  vtkNew<vtkSphereSource> source;
  source->SetRadius(10);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  TriangleMesh mesh;
  vtkPolyData* data = source->GetOutput();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    const double* p = data->GetPoint(i);
    mesh.vertices_mm.emplace_back(float(p[0]), float(p[1]), float(p[2]));
  }
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkNew<vtkIdList> ids;
    data->GetCellPoints(i, ids);
    mesh.triangles.push_back({int(ids->GetId(0)), int(ids->GetId(1)), int(ids->GetId(2))});
  }
  return mesh;
}

double lengthOf(const ContourLine& line) {
  double length_mm = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length_mm += (line[i] - line[i - 1]).norm();
  return length_mm;
}

TEST(PlaneContours, ASphereIsCutInOneClosedCircle) {
  const auto lines = planeContours(sphere(100), SectionPlane{{0, 0, 3}, {0, 0, 1}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back()) << "closed";
  const double radius_mm = std::sqrt(100 - 9.0);
  for (const Eigen::Vector3f& p : lines[0]) {
    EXPECT_NEAR(p.z(), 3, 1e-5);
    EXPECT_NEAR(p.head<2>().norm(), radius_mm, 0.02);  // of chords of 100 a turn
  }
  EXPECT_NEAR(lengthOf(lines[0]), 2 * M_PI * radius_mm, 0.1);
}

TEST(PlaneContours, APlaneThroughVerticesStillGivesClosedLines) {
  const auto lines = planeContours(sphere(64), SectionPlane{{0, 0, 0}, {0, 1, 0}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_TRUE(planeContours(sphere(16), SectionPlane{{0, 0, 11}, {0, 0, 1}}).empty());
}

TEST(PlaneContours, AnOpenSurfaceGivesAnOpenLineAndTwoSheetsTwo) {
  TriangleMesh sheets;
  for (const float z : {0.0f, 5.0f}) {
    const int first = int(sheets.vertices_mm.size());
    for (const float x : {0.0f, 4.0f})
      for (const float y : {0.0f, 4.0f}) sheets.vertices_mm.emplace_back(x, y, z);
    sheets.triangles.push_back({first, first + 1, first + 2});
    sheets.triangles.push_back({first + 1, first + 3, first + 2});
  }
  const auto lines = planeContours(sheets, SectionPlane{{1, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(lines.size(), 2u);
  for (const ContourLine& line : lines) {
    EXPECT_NE(line.front(), line.back());
    EXPECT_NEAR(lengthOf(line), 4, 1e-5);
  }
}

TEST(PlaneContours, AgreesWithVtksCutter) {
  vtkNew<vtkSphereSource> source;
  source->SetRadius(10);
  source->SetThetaResolution(50);
  source->SetPhiResolution(50);
  vtkNew<vtkPlane> plane;
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  plane->SetNormal(normal.x(), normal.y(), normal.z());
  plane->SetOrigin(1, 1, 1);
  vtkNew<vtkCutter> cutter;
  cutter->SetInputConnection(source->GetOutputPort());
  cutter->SetCutFunction(plane);
  cutter->Update();
  double vtk_mm = 0;
  vtkPolyData* cut = cutter->GetOutput();
  for (vtkIdType i = 0; i < cut->GetNumberOfCells(); ++i) {
    vtkNew<vtkIdList> ids;
    cut->GetCellPoints(i, ids);
    Eigen::Vector3d a, b;
    cut->GetPoint(ids->GetId(0), a.data());
    cut->GetPoint(ids->GetId(1), b.data());
    vtk_mm += (b - a).norm();
  }
  double ours_mm = 0;
  for (const auto& line : planeContours(sphere(50), SectionPlane{{1, 1, 1}, normal}))
    ours_mm += lengthOf(line);
  EXPECT_NEAR(ours_mm, vtk_mm, 1e-3);  // float coordinates
}

TEST(PlaneContours, ManyPlanesGiveWhatEachAloneGives) {
  const TriangleMesh mesh = sphere(40);
  std::vector<SectionPlane> planes;
  for (int i = 0; i < 9; ++i) planes.push_back({{0, 0, i - 4.0}, {0, 0, 1}});
  const auto together = planeContours(mesh, planes);
  for (std::size_t i = 0; i < planes.size(); ++i)
    EXPECT_EQ(together[i], planeContours(mesh, planes[i]));
}

TEST(PlaneContours, PointsNearThePlaneAreKept) {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0.4f}, {1, 1, -0.6f}, {2, 2, -0.5f}};
  EXPECT_EQ(pointsNearPlane(points, SectionPlane{{0, 0, 0}, {0, 0, 1}}, 0.5).size(), 2u);
}

TEST(ClipLine, KeepsWhatLiesInside) {
  const auto pieces = clipLine({{-2, 0}, {0, 0}, {0, 3}, {0.5, 3}, {0.5, -3}}, {1, 1});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0], (std::vector<Eigen::Vector2d>{{-1, 0}, {0, 0}, {0, 1}}));
  EXPECT_EQ(pieces[1], (std::vector<Eigen::Vector2d>{{0.5, 1}, {0.5, -1}}));
  EXPECT_TRUE(clipLine({{2, 2}, {3, 0}}, {1, 1}).empty());
}

}  // namespace
}  // namespace softscope
