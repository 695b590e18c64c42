// toolkit/inspection/describe_mesh.cpp: facts about a surface or a point cloud.
#include <algorithm>

#include "core/length_unit.h"
#include "io/files/file_bytes.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "toolkit/inspection/describe_file.h"
#include "toolkit/run/ply_points.h"

namespace softscope {
namespace {

constexpr const char* kUnitOptions =
    "--reference-unit-mm or --test-unit-mm (compare), --reference-unit-mm (evaluate), --unit-mm "
    "(slice, figure), --input-unit-mm (export, which writes mm) or --set organ.unit_mm (simulate)";

template <class Vector>
std::string triple(const Vector& v) {
  return fixed(v[0], 2) + ", " + fixed(v[1], 2) + ", " + fixed(v[2], 2);
}

template <class Vector>
void addBox(const Vector& low_mm, const Vector& high_mm, FactSheet& facts) {
  const Vector size_mm = high_mm - low_mm;
  facts.add("box", triple(low_mm) + " to " + triple(high_mm) + " mm", "box_low_mm",
            {low_mm[0], low_mm[1], low_mm[2]});
  facts.addQuietly("box_high_mm", {high_mm[0], high_mm[1], high_mm[2]});
  facts.add(
      "size",
      fixed(size_mm[0], 1) + " x " + fixed(size_mm[1], 1) + " x " + fixed(size_mm[2], 1) + " mm",
      "size_mm", {size_mm[0], size_mm[1], size_mm[2]});
}

void addSurface(const MeshCheck& check, FactSheet& facts) {
  facts.add("closed", check.closed() ? "yes" : "no", "closed", check.closed());
  facts.add("manifold", check.manifold() ? "yes" : "no", "manifold", check.manifold());
  facts.add("pieces", "pieces", int(check.components));
  facts.add("area", fixed(check.area_mm2 / 100, 2) + " cm²", "area_mm2", check.area_mm2);
  if (check.closed() && check.oriented())
    facts.add("volume", fixed(check.volume_mm3 / 1000, 2) + " ml", "volume_mm3", check.volume_mm3);
}

FactSheet describePoints(const std::string& bytes, const std::string& file) {
  const PlyPoints points = describePlyPoints(bytes, file);
  FactSheet facts(file + ": points without a surface");
  facts.addQuietly("kind", "points");
  facts.add("points", "points", int(points.count));
  std::string properties;
  for (const std::string& property : points.properties) properties += property + " ";
  facts.add("each has", properties, "properties", points.properties);
  for (const std::string& comment : points.comments) facts.addLine("header says", comment);
  facts.addQuietly("comments", points.comments);
  const double unit_mm =
      unitOfFileMm(kUnitOfFile, std::string_view(bytes).substr(0, bytes.find("end_header")));
  facts.addQuietly("unit_mm", unit_mm);
  if (!points.box_mm.isEmpty())
    addBox<Eigen::Vector3d>(unit_mm * points.box_mm.min(), unit_mm * points.box_mm.max(), facts);
  if (points.count == 0) facts.warn("no points");
  if (points.invalid > 0)
    facts.warn(std::to_string(points.invalid) +
               " points have coordinates that are no numbers within 10 km");
  return facts;
}

}  // namespace

FactSheet describeMesh(const std::string& file) {
  const std::string bytes = readBytes(file);
  if (isPlyOfPoints(bytes, file)) return describePoints(bytes, file);
  const TriangleMesh mesh = parseMesh(bytes, file);
  const MeshCheck check = checkMesh(mesh);
  FactSheet facts(file + ": a mesh");
  facts.addQuietly("kind", "mesh");
  facts.add("vertices", "vertices", int(mesh.vertices_mm.size()));
  facts.add("triangles", "triangles", int(mesh.triangles.size()));
  facts.add("colours", mesh.colours.empty() ? "no" : "yes", "colours", !mesh.colours.empty());
  addBox<Eigen::Vector3f>(check.low_mm, check.high_mm, facts);
  if (mesh.unit_mm != 1)
    facts.addLine("unit", fixed(mesh.unit_mm, 0) + " mm in the file, as its header states");
  facts.addQuietly("unit_mm", mesh.unit_mm);
  facts.add("space", mesh.space.empty() ? "not said" : mesh.space, "space", mesh.space);
  addSurface(check, facts);
  facts.addQuietly("likely_unit_mm", check.likely_unit_mm);
  for (const std::string& warning : meshWarnings(check, kUnitOptions)) facts.warn(warning);
  if (mesh.space.empty()) facts.missing("SPACE=LPS or SPACE=RAS in the header; LPS is assumed");
  return facts;
}

}  // namespace softscope
