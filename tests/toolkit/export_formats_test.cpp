// tests/toolkit/export_formats_test.cpp: exported files, read by readers of other libraries.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "mesh/mesh_writer.h"
#include "support/in_folder.h"
#include "toolkit/export/export_files.h"
#include "toolkit/export/export_gltf.h"

namespace softscope::test {
namespace {

constexpr double kFloat = 1e-6;  // relative to 1: what float keeps of a coordinate of some mm

/// A strip of triangles, each vertex with a normal, a colour and a weight of its own.
ModelSurface makeStrip() {
  ModelSurface strip;
  for (int i = 0; i < 12; ++i) {
    strip.vertices.points_mm.emplace_back(0.3f * float(i), float(i % 2), 5.25f - 0.1f * float(i));
    strip.vertices.normals.push_back(Eigen::Vector3f(0.1f * float(i), 0.2f, -1).normalized());
    strip.vertices.colours.push_back({std::uint8_t(20 * i), std::uint8_t(255 - 20 * i), 128});
    strip.vertices.weights.push_back(0.5f * float(i));
  }
  for (int i = 0; i + 2 < 12; ++i)
    strip.triangles.push_back(i % 2 == 0 ? Triangle{i, i + 2, i + 1} : Triangle{i, i + 1, i + 2});
  strip.space = "LPS";
  return strip;
}

class ExportFormats : public InFolder {
 protected:
  std::string file(const std::string& name, const ModelSurface& surface,
                   const std::string& unit = "") const {
    const ModelFormat format = formatOf(name);
    return write(name, modelBytes(surface, format, unitOf(unit, format)));
  }
};

void expectPoints(vtkPolyData* data, const ModelSurface& surface, double unit_mm = 1) {
  ASSERT_EQ(data->GetNumberOfPoints(), vtkIdType(surface.vertices.points_mm.size()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(data->GetPoint(i)[axis] * unit_mm,
                  surface.vertices.points_mm[std::size_t(i)][axis], 6 * kFloat)
          << i;
}

void expectTriangles(vtkPolyData* data, const ModelSurface& surface) {
  ASSERT_EQ(data->GetNumberOfCells(), vtkIdType(surface.triangles.size()));
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkNew<vtkIdList> corners;
    data->GetCellPoints(i, corners);
    ASSERT_EQ(corners->GetNumberOfIds(), 3);
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(corners->GetId(k), surface.triangles[std::size_t(i)][std::size_t(k)]) << i;
  }
}

void expectVectors(vtkDataArray* found, const std::vector<Eigen::Vector3f>& expected) {
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(found->GetNumberOfTuples(), vtkIdType(expected.size()));
  for (vtkIdType i = 0; i < found->GetNumberOfTuples(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(found->GetComponent(i, axis), expected[std::size_t(i)][axis], kFloat) << i;
}

void expectColours(vtkDataArray* found, const std::vector<Rgb8>& expected) {
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(found->GetNumberOfTuples(), vtkIdType(expected.size()));
  for (vtkIdType i = 0; i < found->GetNumberOfTuples(); ++i) {
    const Rgb8& colour = expected[std::size_t(i)];
    ASSERT_EQ(found->GetComponent(i, 0), colour.red) << i;
    ASSERT_EQ(found->GetComponent(i, 1), colour.green) << i;
    ASSERT_EQ(found->GetComponent(i, 2), colour.blue) << i;
  }
}

std::string fieldText(vtkPolyData* data, const char* name) {
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array == nullptr ? "" : std::string(array->GetValue(0));
}

TEST_F(ExportFormats, VtkReadsOurVtp) {
  const ModelSurface strip = makeStrip();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file("a.vtp", strip).c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  expectPoints(data, strip);
  expectTriangles(data, strip);
  expectVectors(data->GetPointData()->GetNormals(), strip.vertices.normals);
  expectColours(data->GetPointData()->GetArray("RGB"), strip.vertices.colours);
  ASSERT_NE(data->GetPointData()->GetArray("weight"), nullptr);
  EXPECT_EQ(data->GetPointData()->GetArray("weight")->GetComponent(3, 0), 1.5);
  EXPECT_EQ(fieldText(data, "SPACE"), "LPS");
  EXPECT_EQ(fieldText(data, "UNIT"), "mm");
}

TEST_F(ExportFormats, VtkReadsOurVtpOfPoints) {
  ModelSurface points = makeStrip();
  points.triangles.clear();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file("a.vtp", points, "cm").c_str());
  reader->Update();
  expectPoints(reader->GetOutput(), points, 10);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfVerts(), 12);
  EXPECT_EQ(fieldText(reader->GetOutput(), "UNIT"), "cm");
}

TEST_F(ExportFormats, VtkReadsOurPly) {
  const ModelSurface strip = makeStrip();
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file("a.ply", strip).c_str());
  reader->Update();
  expectPoints(reader->GetOutput(), strip);
  expectTriangles(reader->GetOutput(), strip);
  expectVectors(reader->GetOutput()->GetPointData()->GetNormals(), strip.vertices.normals);
  expectColours(reader->GetOutput()->GetPointData()->GetArray("RGB"), strip.vertices.colours);
}

TEST_F(ExportFormats, VtkReadsOurObj) {
  const ModelSurface strip = makeStrip();
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(file("a.obj", strip).c_str());
  reader->Update();
  expectPoints(reader->GetOutput(), strip);
  expectTriangles(reader->GetOutput(), strip);
  expectVectors(reader->GetOutput()->GetPointData()->GetNormals(), strip.vertices.normals);
}

TEST_F(ExportFormats, VtkReadsOurStl) {
  const ModelSurface strip = makeStrip();
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(file("a.stl", strip, "m").c_str());
  reader->Update();  // it merges equal corners in the order of their appearance
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfCells(), vtkIdType(strip.triangles.size()));
  EXPECT_EQ(data->GetNumberOfPoints(), 12);
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkNew<vtkIdList> corners;
    data->GetCellPoints(i, corners);
    for (int k = 0; k < 3; ++k) {
      const auto vertex = std::size_t(strip.triangles[std::size_t(i)][std::size_t(k)]);
      ASSERT_NEAR(data->GetPoint(corners->GetId(k))[0] * 1000, strip.vertices.points_mm[vertex].x(),
                  6 * kFloat);
    }
  }
}

using OpenMeshSurface = OpenMesh::TriMesh_ArrayKernelT<>;

/// Reads positions, normals and colours; OpenMesh warns of unknown properties.
OpenMeshSurface readByOpenMesh(const std::string& file, bool with_colours) {
  OpenMeshSurface mesh;
  mesh.request_vertex_normals();
  mesh.request_vertex_colors();
  OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal;
  if (with_colours) options += OpenMesh::IO::Options::VertexColor;
  testing::internal::CaptureStderr();
  EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, file, options));
  testing::internal::GetCapturedStderr();
  return mesh;
}

TEST_F(ExportFormats, OpenMeshReadsOurPlyAndObj) {
  const ModelSurface strip = makeStrip();
  for (const char* name : {"a.ply", "a.obj"}) {
    SCOPED_TRACE(name);
    const OpenMeshSurface mesh = readByOpenMesh(file(name, strip), true);
    ASSERT_EQ(mesh.n_vertices(), 12u);
    ASSERT_EQ(mesh.n_faces(), strip.triangles.size());
    for (const auto vertex : mesh.vertices()) {
      const auto i = std::size_t(vertex.idx());
      const Rgb8& colour = strip.vertices.colours[i];
      for (unsigned axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(mesh.point(vertex)[axis], strip.vertices.points_mm[i][axis], 6 * kFloat);
      // Colours of an OBJ have four digits; OpenMesh truncates, softscope rounds: one step of 255.
      ASSERT_NEAR(mesh.color(vertex)[0], colour.red, 1);
      ASSERT_NEAR(mesh.color(vertex)[1], colour.green, 1);
      ASSERT_NEAR(mesh.color(vertex)[2], colour.blue, 1);
    }
  }
}

/// The single polygon data of a glTF file, as read by VTK, and its owner.
vtkPolyData* firstPolyData(vtkMultiBlockDataSet* blocks) {
  for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i) {
    if (auto* data = vtkPolyData::SafeDownCast(blocks->GetBlock(i))) return data;
    if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(i)))
      if (auto* data = firstPolyData(inner)) return data;
  }
  return nullptr;
}

double linearLight(std::uint8_t channel) {
  const double share = channel / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

TEST_F(ExportFormats, VtkReadsOurGltfUprightAndInMetres) {
  for (const char* name : {"a.glb", "a.gltf"}) {
    SCOPED_TRACE(name);
    ModelSurface strip = makeStrip();
    strip.space.clear();
    strip.frame = "world";
    vtkNew<vtkGLTFReader> reader;
    reader->SetFileName(file(name, strip).c_str());
    reader->ApplyDeformationsToGeometryOn();
    reader->Update();
    vtkPolyData* data = firstPolyData(reader->GetOutput());
    ASSERT_NE(data, nullptr);
    ModelSurface upright = strip;  // half a turn about x: y up, the scope at +z
    for (Eigen::Vector3f& p : upright.vertices.points_mm) p.tail<2>() *= -1;
    for (Eigen::Vector3f& n : upright.vertices.normals) n.tail<2>() *= -1;
    expectPoints(data, upright, 1000);
    expectTriangles(data, strip);
    expectVectors(data->GetPointData()->GetArray("NORMAL"), upright.vertices.normals);
    vtkDataArray* colours = data->GetPointData()->GetArray("COLOR_0");
    ASSERT_NE(colours, nullptr);
    const double full = colours->GetComponent(0, 3);  // opaque: 1, or the type's largest value
    for (vtkIdType i = 0; i < 12; ++i)
      ASSERT_NEAR(colours->GetComponent(i, 0) / full,
                  linearLight(strip.vertices.colours[std::size_t(i)].red), 1e-4);
  }
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

TEST(Gltf, IsAlignedAndSaysItsExtent) {
  const ModelSurface strip = makeStrip();
  const std::string bytes = glbFile(strip);
  ASSERT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(wordAt(bytes, 4), 2u);
  EXPECT_EQ(wordAt(bytes, 8), bytes.size());
  const std::size_t json_bytes = wordAt(bytes, 12);
  EXPECT_EQ(json_bytes % 4, 0u);
  const auto json = nlohmann::json::parse(bytes.substr(20, json_bytes));
  EXPECT_EQ(bytes.substr(24 + json_bytes, 3), "BIN");
  EXPECT_EQ(wordAt(bytes, 20 + json_bytes) % 4, 0u);
  EXPECT_EQ(wordAt(bytes, 20 + json_bytes), bytes.size() - 28 - json_bytes);
  for (const auto& view : json.at("bufferViews"))
    EXPECT_EQ(view.at("byteOffset").get<std::size_t>() % 4, 0u);
  EXPECT_EQ(json.at("asset").at("extras").at("SPACE"), "LPS");
  const auto& position = json.at("accessors").at(0);
  EXPECT_NEAR(position.at("max").at(0).get<double>(), 3.3e-3, 1e-9);
  EXPECT_NEAR(position.at("min").at(2).get<double>(), 4.15e-3, 1e-9);
  EXPECT_EQ(json.at("meshes").at(0).at("primitives").at(0).at("mode"), 4);
}

TEST(Gltf, OfPointsHasNoIndices) {
  ModelSurface points = makeStrip();
  points.triangles.clear();
  const std::string text = gltfFile(points);
  const auto primitive = nlohmann::json::parse(text).at("meshes").at(0).at("primitives").at(0);
  EXPECT_EQ(primitive.at("mode"), 0);
  EXPECT_FALSE(primitive.contains("indices"));
}

TEST(MeshWriter, NamesUnitSpaceAndFrame) {
  ModelSurface strip = makeStrip();
  EXPECT_NE(plyFile(strip).find("comment SPACE=LPS\n"), std::string::npos);
  EXPECT_NE(objFile(strip).find("# SPACE=LPS\n"), std::string::npos);
  EXPECT_NE(stlFile(strip).substr(0, 80).find("SPACE=LPS"), std::string::npos);
  strip.space.clear();
  strip.frame = "world";
  EXPECT_NE(plyFile(strip, {"m", 1000}).find("comment unit m\ncomment frame world\n"),
            std::string::npos);
}

TEST(MeshWriter, RefusesWhatDoesNotBelongTogether) {
  ModelSurface strip = makeStrip();
  strip.vertices.normals.pop_back();
  EXPECT_THROW(plyFile(strip), Error);
  strip = makeStrip();
  strip.triangles[0][1] = 12;
  EXPECT_THROW(glbFile(strip), Error);
  strip.triangles.clear();
  EXPECT_THROW(stlFile(strip), Error);
  EXPECT_THROW(objFile(strip), Error);
}

}  // namespace
}  // namespace softscope::test
