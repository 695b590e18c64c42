// toolkit/comparison/compare_inputs.cpp: formats by content; VTK files by extension.
#include "toolkit/comparison/compare_inputs.h"

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "mesh/mesh_reader.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/ply_points.h"
#include "toolkit/run/table_reader.h"
#include "vtk_views/files/vtp_surface.h"

namespace softscope {
namespace {

/// LPS or RAS from the comments of the header.
std::string spaceOf(std::string_view header) {
  for (const char* space : {"LPS", "RAS"})
    if (header.find(std::string("SPACE=") + space) != std::string_view::npos) return space;
  return {};
}

TriangleMesh pointsFrom(const std::string& bytes, const std::string& name, double unit_mm) {
  TriangleMesh points;
  ModelFile file = parseModel(bytes, name, unit_mm);
  points.vertices_mm = std::move(file.model.positions_mm);
  points.unit_mm = file.unit_mm;
  points.space = spaceOf(std::string_view(bytes).substr(0, bytes.find("end_header")));
  return points;
}

std::string spaceOrLps(const TriangleMesh& mesh) { return mesh.space.empty() ? "LPS" : mesh.space; }

}  // namespace

TriangleMesh readSurfaceOrPoints(const std::filesystem::path& file, double unit_mm) {
  const MeshReadOptions options{unit_mm};
  options.validate();
  if (looksLikeVtkSurface(file.string())) {
    requireFile(file);
    return readVtkSurface(file.string(), unit_mm);
  }
  const std::string bytes = readBytes(file, std::uintmax_t{2} << 30), name = shown(file);
  return isPlyOfPoints(bytes, name) ? pointsFrom(bytes, name, unit_mm)
                                    : parseMesh(bytes, name, options);
}

Landmarks readLandmarks(const std::filesystem::path& file) {
  const NumberTable table(
      readText(file, kTextLimitBytes), shown(file),
      {"test_x_mm", "test_y_mm", "test_z_mm", "reference_x_mm", "reference_y_mm", "reference_z_mm"},
      {});
  Landmarks landmarks;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    landmarks.test_mm.push_back(table.placeAt(i, 0));
    landmarks.reference_mm.push_back(table.placeAt(i, 3));
    if (!landmarks.test_mm.back().allFinite() || !landmarks.reference_mm.back().allFinite())
      throw InputError(say(shown(file), ": landmark ", i + 1,
                           " lacks a coordinate; complete it or delete its line"));
  }
  if (table.rows() < 3)
    throw InputError(say(shown(file), ": has ", table.rows(),
                         " landmarks, but a rigid alignment takes three or more"));
  return landmarks;
}

std::string matchSpaces(const TriangleMesh& reference, TriangleMesh& test) {
  if (reference.space.empty() && test.space.empty()) return "unknown in both files; assumed equal";
  if (reference.space == test.space) return reference.space + ", according to both files";
  const std::string expected = spaceOrLps(reference), found = spaceOrLps(test);
  test.space = reference.space;
  if (expected == found) return expected + ", according to one file and assumed of the other";
  for (Eigen::Vector3f& p : test.vertices_mm) {
    p.x() = -p.x();
    p.y() = -p.y();
  }
  return expected + "; the test was " + found + ", so its x and y were negated";
}

}  // namespace softscope
