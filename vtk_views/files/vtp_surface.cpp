// vtk_views/files/vtp_surface.cpp: conversion from vtkPolyData.
#include "vtk_views/files/vtp_surface.h"

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/guarded_read.h"
#include "vtk_views/files/packed_bytes.h"
#include "vtk_views/files/vtk_errors.h"

namespace softscope {
namespace {

constexpr float kFarthestPointMm = 1e7f;

std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

/// Empty without such a field.
std::string textFieldOf(vtkPolyData* data, const char* name) {
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array != nullptr && array->GetNumberOfValues() > 0 ? std::string(array->GetValue(0)) : "";
}

std::string spaceOf(vtkPolyData* data, const std::string& title) {
  if (const std::string value = textFieldOf(data, "SPACE"); value == "LPS" || value == "RAS")
    return value;
  for (const char* space : {"LPS", "RAS"})
    if (title.find(std::string("SPACE=") + space) != std::string::npos) return space;
  return {};
}

void addPoints(vtkPolyData* data, const std::string& path, TriangleMesh& mesh) {
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    const double* p = data->GetPoint(i);
    mesh.vertices_mm.emplace_back(float(p[0]), float(p[1]), float(p[2]));
    const Eigen::Vector3f& point = mesh.vertices_mm.back();
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kFarthestPointMm)
      throw InputError(
          path + ": point " + std::to_string(i) +
          " is not finite, or more than 10 km from the origin; export the surface again");
  }
}

/// Polygons are split into fans around their first corner.
void addTriangles(vtkCellArray* polygons, const std::string& path, TriangleMesh& mesh) {
  const auto count = static_cast<vtkIdType>(mesh.vertices_mm.size());
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i) {
    polygons->GetCellAtId(i, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      if (corners->GetId(k) < 0 || corners->GetId(k) >= count)
        throw InputError(path + ": polygon " + std::to_string(i) +
                         " names a point that isn't there; export the surface again");
    for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k)
      mesh.triangles.push_back({static_cast<std::int32_t>(corners->GetId(0)),
                                static_cast<std::int32_t>(corners->GetId(k - 1)),
                                static_cast<std::int32_t>(corners->GetId(k))});
  }
}

TriangleMesh meshOf(vtkPolyData* data, const std::string& title, const std::string& path) {
  TriangleMesh mesh;
  if (data == nullptr || data->GetNumberOfPoints() == 0)
    throw InputError(path + ": holds no points. Is it complete, and a surface?");
  addPoints(data, path, mesh);
  addTriangles(data->GetPolys(), path, mesh);
  mesh.space = spaceOf(data, title);
  const std::string unit = textFieldOf(data, "UNIT");
  mesh.unit_mm = unitOfFileMm(kUnitOfFile, unit.empty() ? title : "unit " + unit);
  return mesh;
}

TriangleMesh readWithVtk(const std::string& path) {
  if (endingOf(path) == ".vtp") {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    updateOrThrow(*reader, path);
    return meshOf(reader->GetOutput(), "", path);
  }
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  updateOrThrow(*reader, path);
  const char* title = reader->GetHeader();
  return meshOf(reader->GetOutput(), title == nullptr ? "" : title, path);
}

std::string packMesh(const TriangleMesh& mesh) {
  BytePacker packer;
  packer.addAll(mesh.vertices_mm);
  packer.addAll(mesh.triangles);
  packer.addText(mesh.space);
  packer.add(mesh.unit_mm);
  return std::move(packer.bytes);
}

}  // namespace

bool looksLikeVtkSurface(const std::string& path) {
  const std::string ending = endingOf(path);
  return ending == ".vtp" || ending == ".vtk";
}

TriangleMesh readVtkSurface(const std::string& path, double unit_mm) {
  requireRegularFile(path);
  const std::string bytes = guardedRead(path, std::filesystem::file_size(path),
                                        [&] { return packMesh(readWithVtk(path)); });
  TriangleMesh mesh;
  ByteUnpacker unpacker(bytes);
  unpacker.takeAll(mesh.vertices_mm);
  unpacker.takeAll(mesh.triangles);
  unpacker.takeText(mesh.space);
  unpacker.take(mesh.unit_mm);
  if (!std::isnan(unit_mm)) mesh.unit_mm = unit_mm;
  toMillimetres(mesh.unit_mm, &mesh.vertices_mm);
  return mesh;
}

}  // namespace softscope
