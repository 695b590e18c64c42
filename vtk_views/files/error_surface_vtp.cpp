// vtk_views/files/error_surface_vtp.cpp: arrays by name, written by VTK.
#include "vtk_views/files/error_surface_vtp.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"

namespace softscope {
namespace {

void addScalars(const char* name, const std::vector<double>& values, vtkPolyData* data) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    array->SetValue(static_cast<vtkIdType>(i), values[i]);
  data->GetPointData()->AddArray(array);
}

void addVectors(const char* name, const std::vector<Eigen::Vector3f>& vectors, vtkPolyData* data) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i)
    array->SetTypedTuple(static_cast<vtkIdType>(i), vectors[i].data());
  data->GetPointData()->AddArray(array);
}

void addSpace(const std::string& space, vtkPolyData* data) {
  if (space.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName("SPACE");
  array->InsertNextValue(space);
  data->GetFieldData()->AddArray(array);
}

void addCells(const TriangleMesh& mesh, vtkPolyData* data) {
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : mesh.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  if (!mesh.empty()) return data->SetPolys(cells);
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(mesh.vertices_mm.size()); ++i)
    cells->InsertNextCell(1, &i);
  data->SetVerts(cells);
}

}  // namespace

std::string errorSurfaceVtp(const TriangleMesh& mesh, const VertexErrors& errors) {
  const std::size_t count = mesh.vertices_mm.size();
  if (errors.signed_mm.size() != count || errors.absolute_mm.size() != count ||
      errors.to_reference_mm.size() != count)
    throw Error("error surface: every vertex needs one signed, absolute and vector error");
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i)
    points->SetPoint(static_cast<vtkIdType>(i), mesh.vertices_mm[i].x(), mesh.vertices_mm[i].y(),
                     mesh.vertices_mm[i].z());
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  addCells(mesh, data);
  addScalars("Signed", errors.signed_mm, data);
  addScalars("Absolute", errors.absolute_mm, data);
  addVectors("ToReference", errors.to_reference_mm, data);
  addSpace(mesh.space, data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw Error("VTK could not write a surface with errors as VTP");
  return writer->GetOutputString();
}

}  // namespace softscope
