// vtk_views/files/surface_vtp.cpp: arrays, then VTK's writer.
#include "vtk_views/files/surface_vtp.h"

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"

namespace softscope {
namespace {

void addText(const char* name, const std::string& value, vtkPolyData* data) {
  if (value.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

void addPoints(const PointCloud& vertices, const LengthUnit& unit, vtkPolyData* data) {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(vertices.points_mm.size()));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3d p =
        vertices.points_mm[static_cast<std::size_t>(i)].cast<double>() / unit.mm;
    points->SetPoint(i, p.data());
  }
  data->SetPoints(points);
}

void addCells(const ModelSurface& surface, vtkPolyData* data) {
  vtkNew<vtkCellArray> cells;
  for (const Triangle& t : surface.triangles) {
    const vtkIdType corners[] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  if (!surface.triangles.empty()) return data->SetPolys(cells);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
  data->SetVerts(cells);
}

void addArrays(const PointCloud& vertices, vtkPolyData* data) {
  vtkNew<vtkFloatArray> normals, weights, sigmas;
  vtkNew<vtkUnsignedCharArray> colours;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (const Eigen::Vector3f& normal : vertices.normals) {
    const Eigen::Vector3f shown = normal.allFinite() ? normal : Eigen::Vector3f(0, 0, 0);
    normals->InsertNextTypedTuple(shown.data());
  }
  colours->SetName("RGB");
  colours->SetNumberOfComponents(3);
  for (const Rgb8& colour : vertices.colours) {
    const unsigned char channels[] = {colour.red, colour.green, colour.blue};
    colours->InsertNextTypedTuple(channels);
  }
  weights->SetName("weight");
  for (const float weight : vertices.weights) weights->InsertNextValue(weight);
  sigmas->SetName("sigma_mm");
  for (const float sigma_mm : vertices.sigmas_mm) sigmas->InsertNextValue(sigma_mm);
  if (!vertices.normals.empty()) data->GetPointData()->SetNormals(normals);
  if (!vertices.colours.empty()) data->GetPointData()->AddArray(colours);
  if (!vertices.weights.empty()) data->GetPointData()->AddArray(weights);
  if (!vertices.sigmas_mm.empty()) data->GetPointData()->AddArray(sigmas);
}

}  // namespace

std::string surfaceVtp(const ModelSurface& surface, const LengthUnit& unit) {
  vtkNew<vtkPolyData> data;
  addPoints(surface.vertices, unit, data);
  addCells(surface, data);
  addArrays(surface.vertices, data);
  addText("UNIT", unit.name, data);
  addText("SPACE", surface.space, data);
  addText("FRAME", surface.frame, data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw Error("VTK could not write a surface as VTP");
  return writer->GetOutputString();
}

}  // namespace softscope
