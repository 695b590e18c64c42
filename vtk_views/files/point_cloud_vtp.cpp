#include "vtk_views/files/point_cloud_vtp.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"

namespace softscope {
namespace {

template <class Array, class Element, class Fill>
void addArray(vtkPolyData* data, const char* name, int components,
              const std::vector<Element>& elements, Fill fill) {
  if (elements.empty()) return;
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(elements.size()));
  auto* out = array->GetPointer(0);
  for (const Element& element : elements) out = fill(element, out);
  data->GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> polyDataOf(const PointCloud& cloud) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  points->SetNumberOfPoints(static_cast<vtkIdType>(cloud.points_mm.size()));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    const Eigen::Vector3f& p = cloud.points_mm[static_cast<std::size_t>(i)];
    points->SetPoint(i, p.x(), p.y(), p.z());
    vertices->InsertNextCell(1, &i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  addArray<vtkFloatArray>(data, "Normals", 3, cloud.normals,
                          [](const Eigen::Vector3f& n, float* out) {
                            for (int axis = 0; axis < 3; ++axis) *out++ = n[axis];
                            return out;
                          });
  addArray<vtkUnsignedCharArray>(data, "RGB", 3, cloud.colours,
                                 [](const Rgb8& colour, unsigned char* out) {
                                   *out++ = colour.red;
                                   *out++ = colour.green;
                                   *out++ = colour.blue;
                                   return out;
                                 });
  const auto one = [](float value, float* out) {
    *out++ = value;
    return out;
  };
  addArray<vtkFloatArray>(data, "weight", 1, cloud.weights, one);
  addArray<vtkFloatArray>(data, "sigma_mm", 1, cloud.sigmas_mm, one);
  return data;
}

}  // namespace

std::string pointCloudVtp(const PointCloud& cloud) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(polyDataOf(cloud));
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw Error("VTK could not write a point cloud as VTP");
  return writer->GetOutputString();
}

}  // namespace softscope
