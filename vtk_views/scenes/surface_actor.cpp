// vtk_views/scenes/surface_actor.cpp: points, normals, colours and lighting.
#include "vtk_views/scenes/surface_actor.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

constexpr int kSteps = 256;
constexpr Rgb8 kNeutral{205, 205, 205};
constexpr double kSeeThrough = 0.35;  // opacity

vtkSmartPointer<vtkPoints> pointsOf(const TriangleMesh& mesh) {
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(mesh.vertices_mm.size()));
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    values->SetTypedTuple(static_cast<vtkIdType>(i), mesh.vertices_mm[i].data());
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(values);
  return points;
}

/// Area-weighted vertex normals, for smooth shading.
vtkSmartPointer<vtkFloatArray> normalsOf(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> sums(mesh.vertices_mm.size(), Eigen::Vector3f::Zero());
  for (const Triangle& t : mesh.triangles) {
    const auto& a = mesh.vertices_mm[std::size_t(t[0])];
    const Eigen::Vector3f normal =
        (mesh.vertices_mm[std::size_t(t[1])] - a).cross(mesh.vertices_mm[std::size_t(t[2])] - a);
    for (const std::int32_t corner : t) sums[std::size_t(corner)] += normal;
  }
  auto normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(static_cast<vtkIdType>(sums.size()));
  for (std::size_t i = 0; i < sums.size(); ++i)
    normals->SetTypedTuple(static_cast<vtkIdType>(i), sums[i].normalized().eval().data());
  return normals;
}

vtkSmartPointer<vtkDoubleArray> scalarsOf(const std::vector<double>& errors_mm) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfTuples(static_cast<vtkIdType>(errors_mm.size()));
  std::copy(errors_mm.begin(), errors_mm.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> textureOf(const std::vector<Rgb8>& colours) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const unsigned char rgb[] = {colours[i].red, colours[i].green, colours[i].blue};
    array->SetTypedTuple(static_cast<vtkIdType>(i), rgb);
  }
  return array;
}

/// Colours of the bar in invisibly small steps.
vtkSmartPointer<vtkLookupTable> tableOf(const ErrorColours& colours) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  const auto set = [&](double value, auto&& put) {
    const Rgb8 c = colours.colour(value);
    put(c.red / 255.0, c.green / 255.0, c.blue / 255.0);
  };
  table->SetTableRange(colours.low_mm(), colours.limit_mm);
  table->SetNumberOfTableValues(kSteps);
  for (int i = 0; i < kSteps; ++i)
    set(colours.low_mm() + i / (kSteps - 1.0) * (colours.limit_mm - colours.low_mm()),
        [&](double r, double g, double b) { table->SetTableValue(i, r, g, b, 1); });
  set(std::nan(""), [&](double r, double g, double b) { table->SetNanColor(r, g, b, 1); });
  return table;
}

vtkSmartPointer<vtkPolyData> polyDataOf(const SceneSurface& surface, const SurfaceRole& role) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(pointsOf(surface.mesh));
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : surface.mesh.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  if (surface.isPoints()) {
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
    data->SetVerts(cells);
  } else {
    data->SetPolys(cells);
    if (!role.unlit) data->GetPointData()->SetNormals(normalsOf(surface.mesh));
  }
  if (!surface.errors_mm.empty())
    data->GetPointData()->SetScalars(scalarsOf(surface.errors_mm));
  else if (surface.mesh.colours.size() == surface.mesh.vertices_mm.size())
    data->GetPointData()->SetScalars(textureOf(surface.mesh.colours));
  return data;
}

void light(const SceneSurface& surface, const SurfaceRole& role, vtkProperty* look) {
  if (role.unlit || surface.isPoints() || !surface.errors_mm.empty()) {
    look->LightingOff();  // shading would change the colours of the colour bar
    return;
  }
  look->LightingOn();
  look->SetAmbient(0.3);
  look->SetDiffuse(role.neutral ? 0.55 : 0.8);  // grey where it faces the viewer, not white
  look->SetSpecular(role.neutral ? 0 : 0.15);
  look->SetSpecularPower(20);
}

}  // namespace

void redressSurface(const SceneSurface& surface, const ErrorColours& colours,
                    const SurfaceRole& role, vtkActor* actor) {
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  mapper->SetInputData(polyDataOf(surface, role));
  if (!surface.errors_mm.empty()) {
    mapper->SetLookupTable(tableOf(colours));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();  // interpolates errors, not colours
  } else {
    mapper->InterpolateScalarsBeforeMappingOff();
  }
  vtkProperty* look = actor->GetProperty();
  const Rgb8 colour = role.neutral ? kNeutral : surface.colour;
  look->SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  look->SetPointSize(float(role.point_size_px));
  actor->SetPosition(role.shift_mm.x(), role.shift_mm.y(), role.shift_mm.z());
  light(surface, role, look);
  look->SetOpacity(role.see_through ? kSeeThrough : 1);
  look->SetBackfaceCulling(role.see_through);  // one layer only: correct without sorting
}

vtkSmartPointer<vtkActor> surfaceActor(const SceneSurface& surface, const ErrorColours& colours,
                                       const SurfaceRole& role) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  actor->SetMapper(mapper);
  redressSurface(surface, colours, role, actor);
  return actor;
}

}  // namespace softscope
