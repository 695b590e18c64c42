// vtk_views/files/error_map.cpp: nouns to VTK's arrays and back.
#include "vtk_views/files/error_map.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"
#include "core/farthest.h"
#include "core/guarded_read.h"
#include "core/not_measured.h"
#include "vtk_views/files/packed_bytes.h"
#include "vtk_views/files/vtk_errors.h"

namespace softscope {
namespace {

void addScalars(const char* name, const std::vector<float>& values, std::size_t reference_count,
                vtkPolyData* data) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  for (const float value : values) array->InsertNextValue(value);
  for (std::size_t i = 0; i < reference_count; ++i) array->InsertNextValue(kNotMeasured<float>);
  data->GetPointData()->AddArray(array);
}

void addObserved(const ErrorMap& map, vtkPolyData* data) {
  if (map.observed.empty()) return;
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("Observed");
  for (const std::uint8_t seen : map.observed) array->InsertNextValue(seen);
  for (std::size_t i = 0; i < map.reference.vertices_mm.size(); ++i) array->InsertNextValue(0);
  data->GetPointData()->AddArray(array);
}

void addField(const char* name, const std::vector<double>& values, vtkPolyData* data) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values) array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

void addFields(const ErrorMap& map, vtkPolyData* data) {
  addField("ModelPoints", {double(map.surface.vertices_mm.size())}, data);
  addField("Frame", {double(map.frame)}, data);
  if (std::isfinite(map.time_s)) addField("TimeValue", {map.time_s}, data);
  addField("Look", {map.look.x(), map.look.y(), map.look.z()}, data);
  addField("Up", {map.up.x(), map.up.y(), map.up.z()}, data);
  if (map.surface.space.empty()) return;
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue(map.surface.space);
  data->GetFieldData()->AddArray(space);
}

void addTriangles(const TriangleMesh& mesh, vtkIdType first, vtkCellArray* cells) {
  for (const Triangle& t : mesh.triangles) {
    const vtkIdType corners[] = {first + t[0], first + t[1], first + t[2]};
    cells->InsertNextCell(3, corners);
  }
}

void addGeometry(const ErrorMap& map, vtkPolyData* data) {
  vtkNew<vtkPoints> points;
  for (const TriangleMesh* mesh : {&map.surface, &map.reference})
    for (const Eigen::Vector3f& p : mesh->vertices_mm) points->InsertNextPoint(p.data());
  data->SetPoints(points);
  const auto count = static_cast<vtkIdType>(map.surface.vertices_mm.size());
  vtkNew<vtkCellArray> triangles, single;
  addTriangles(map.surface, 0, triangles);
  addTriangles(map.reference, count, triangles);
  if (map.surface.empty())
    for (vtkIdType i = 0; i < count; ++i) single->InsertNextCell(1, &i);
  data->SetVerts(single);
  data->SetPolys(triangles);
}

std::vector<double> fieldOf(vtkPolyData* data, const char* name) {
  std::vector<double> values;
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfValues(); ++i)
    values.push_back(array->GetVariantValue(i).ToDouble());
  return values;
}

std::vector<float> scalarsOf(vtkPolyData* data, const char* array_name, std::size_t count,
                             const std::string& name) {
  vtkDataArray* array = data->GetPointData()->GetArray(array_name);
  if (array == nullptr || array->GetNumberOfComponents() != 1)
    throw InputError(name + ": has no array `" + array_name +
                     "` of one value a point; give what softscope evaluate or compare wrote");
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = static_cast<float>(array->GetTuple1(static_cast<vtkIdType>(i)));
  return values;
}

void readGeometry(vtkPolyData* data, std::size_t model_points, const std::string& name,
                  ErrorMap& map) {
  const auto count = static_cast<std::size_t>(data->GetNumberOfPoints());
  for (std::size_t i = 0; i < count; ++i) {
    double p[3];
    data->GetPoint(static_cast<vtkIdType>(i), p);
    const Eigen::Vector3f place = Eigen::Vector3d(p[0], p[1], p[2]).cast<float>();
    if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kFarthestMm)
      throw InputError(name + ": a point is not finite, or beyond 1 km; is it damaged?");
    (i < model_points ? map.surface : map.reference).vertices_mm.push_back(place);
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray* cells = data->GetPolys();
  const auto split = static_cast<vtkIdType>(model_points);
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
    cells->GetCellAtId(c, corners);
    if (corners->GetNumberOfIds() != 3) throw InputError(name + ": holds a cell of no triangle");
    const bool own = corners->GetId(0) < split;
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      const vtkIdType id = corners->GetId(k);
      if (id < 0 || id >= static_cast<vtkIdType>(count) || (id < split) != own)
        throw InputError(name + ": a triangle names a point that is not there; is it damaged?");
      t[std::size_t(k)] = static_cast<std::int32_t>(own ? id : id - split);
    }
    (own ? map.surface : map.reference).triangles.push_back(t);
  }
}

void readFields(vtkPolyData* data, ErrorMap& map) {
  const auto take = [&](const char* field, Eigen::Vector3f& value) {
    const std::vector<double> found = fieldOf(data, field);
    if (found.size() != 3) return;
    const Eigen::Vector3f read = Eigen::Vector3d(found[0], found[1], found[2]).cast<float>();
    if (read.allFinite() && read.norm() > 1e-6f) value = read.normalized();
  };
  take("Look", map.look);
  take("Up", map.up);
  const std::vector<double> frame = fieldOf(data, "Frame"), time = fieldOf(data, "TimeValue");
  if (frame.size() == 1 && frame[0] >= 0 && frame[0] < 1e9) map.frame = int(frame[0]);
  if (time.size() == 1) map.time_s = time[0];
  auto* space = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SPACE"));
  if (space == nullptr || space->GetNumberOfValues() != 1) return;
  const std::string said = space->GetValue(0);
  if (said == "LPS" || said == "RAS") map.surface.space = said;
}

ErrorMap readErrorMapWithVtk(const std::string& bytes, const std::string& name) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  updateOrThrow(*reader, name);
  vtkPolyData* data = reader->GetOutput();
  const auto count = static_cast<std::size_t>(data->GetNumberOfPoints());
  if (count == 0) throw InputError(name + ": holds no point; is it damaged?");
  const std::vector<double> said = fieldOf(data, "ModelPoints");
  const bool split = said.size() == 1 && said[0] >= 1 && said[0] <= double(count);
  const std::size_t model_points = split ? static_cast<std::size_t>(said[0]) : count;
  ErrorMap map;
  readGeometry(data, model_points, name, map);
  map.absolute_mm = scalarsOf(data, "Absolute", model_points, name);
  map.signed_mm = scalarsOf(data, "Signed", model_points, name);
  if (data->GetPointData()->GetArray("Observed") != nullptr)
    for (const float seen : scalarsOf(data, "Observed", model_points, name))
      map.observed.push_back(seen != 0);
  readFields(data, map);
  return map;
}

void packSurface(const TriangleMesh& mesh, BytePacker& packer) {
  packer.addAll(mesh.vertices_mm);
  packer.addAll(mesh.triangles);
  packer.addText(mesh.space);
}

void unpackSurface(ByteUnpacker& unpacker, TriangleMesh& mesh) {
  unpacker.takeAll(mesh.vertices_mm);
  unpacker.takeAll(mesh.triangles);
  unpacker.takeText(mesh.space);
}

std::string packErrorMap(const ErrorMap& map) {
  BytePacker packer;
  packSurface(map.surface, packer);
  packSurface(map.reference, packer);
  packer.addAll(map.absolute_mm);
  packer.addAll(map.signed_mm);
  packer.addAll(map.observed);
  packer.add(map.frame);
  packer.add(map.time_s);
  for (const Eigen::Vector3f* v : {&map.look, &map.up})
    for (int axis = 0; axis < 3; ++axis) packer.add((*v)[axis]);
  return std::move(packer.bytes);
}

}  // namespace

std::string errorMapVtp(const ErrorMap& map) {
  const std::size_t count = map.surface.vertices_mm.size();
  if (map.absolute_mm.size() != count || map.signed_mm.size() != count ||
      (!map.observed.empty() && map.observed.size() != count))
    throw Error("error map: every vertex needs one error of each kind");
  vtkNew<vtkPolyData> data;
  addGeometry(map, data);
  addScalars("Absolute", map.absolute_mm, map.reference.vertices_mm.size(), data);
  addScalars("Signed", map.signed_mm, map.reference.vertices_mm.size(), data);
  addObserved(map, data);
  addFields(map, data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // a third of the default time, a tenth more bytes
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw Error("VTK could not write an error map as VTP");
  return writer->GetOutputString();
}

ErrorMap parseErrorMap(const std::string& bytes, const std::string& name) {
  const std::string packed = guardedRead(
      name, bytes.size(), [&] { return packErrorMap(readErrorMapWithVtk(bytes, name)); });
  ByteUnpacker unpacker(packed);
  ErrorMap map;
  unpackSurface(unpacker, map.surface);
  unpackSurface(unpacker, map.reference);
  unpacker.takeAll(map.absolute_mm);
  unpacker.takeAll(map.signed_mm);
  unpacker.takeAll(map.observed);
  unpacker.take(map.frame);
  unpacker.take(map.time_s);
  for (Eigen::Vector3f* v : {&map.look, &map.up})
    for (int axis = 0; axis < 3; ++axis) unpacker.take((*v)[axis]);
  return map;
}

}  // namespace softscope
