// tests/mesh/mesh_reader_test.cpp: every form gives the same surface, every fault one line.
#include "mesh/mesh_reader.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "io/temporary_folder.h"
#include "mesh/mesh_texts.h"

namespace softscope::test {
namespace {

struct Form {
  std::string name;
  std::string bytes;
};

std::vector<Form> everyForm() {
  const TriangleMesh mesh = tetrahedron();
  return {{"ascii.stl", asciiStl(mesh)},
          {"binary.stl", binaryStl(mesh)},
          {"solid.stl", binaryStl(mesh, "solid")},
          {"ascii.ply", asciiPly(mesh)},
          {"little.ply", binaryPly(mesh, false)},
          {"big.ply", binaryPly(mesh, true)},
          {"mesh.obj", obj(mesh)}};
}

/// The error's text; fails where there is none, or where it isn't one line that names the file.
std::string errorOf(const std::string& bytes) {
  try {
    parseMesh(bytes, "scan.mesh");
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind("scan.mesh", 0), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

#define EXPECT_TELLS(bytes, part) EXPECT_NE(errorOf(bytes).find(part), std::string::npos)

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(MeshReader, ReadsEveryFormAlike) {
  const TriangleMesh expected = tetrahedron();
  for (const Form& form : everyForm()) {
    SCOPED_TRACE(form.name);
    const TriangleMesh mesh = parseMesh(form.bytes, form.name);
    EXPECT_EQ(mesh.vertices_mm, expected.vertices_mm);
    EXPECT_EQ(mesh.triangles, expected.triangles);
    EXPECT_TRUE(mesh.colours.empty());
    EXPECT_EQ(mesh.space, "");
  }
}

TEST(MeshReader, ReadsFilesWithLineEndsOfWindows) {
  const TriangleMesh mesh = tetrahedron();
  for (std::string text : {asciiStl(mesh), asciiPly(mesh), obj(mesh)}) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
      text.insert(at, "\r");
    EXPECT_EQ(parseMesh(text, "windows").triangles, mesh.triangles);
  }
}

TEST(MeshReader, ReadsTheSpaceFromTheHeader) {
  const TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(parseMesh(asciiStl(mesh, "made SPACE=RAS"), "").space, "RAS");
  EXPECT_EQ(parseMesh(binaryStl(mesh, "3D model, SPACE=LPS"), "").space, "LPS");
  EXPECT_EQ(parseMesh(asciiPly(mesh, "SPACE=LPS"), "").space, "LPS");
  EXPECT_EQ(parseMesh(binaryPly(mesh, true, "SPACE=RAS"), "").space, "RAS");
  EXPECT_EQ(parseMesh(obj(mesh, "# made\n# SPACE=RAS\n"), "").space, "RAS");
  EXPECT_EQ(parseMesh(obj(mesh, "# COLOR_SPACE=sRGB\n"), "").space, "");
  EXPECT_TELLS(asciiPly(mesh, "SPACE=XYZ"), "LPS or RAS");
}

TEST(MeshReader, TurnsTheFilesUnitIntoMillimetres) {
  const TriangleMesh mesh = parseMesh(obj(tetrahedron()), "", {1000});
  EXPECT_EQ(mesh.vertices_mm[1].x(), 1500);
  EXPECT_THROW(parseMesh(obj(tetrahedron()), "", {0}), OptionError);
}

TEST(MeshReader, ReadsColoursAndPassesOverWhatItDoesNotNeed) {
  const std::string text =
      "ply\nformat ascii 1.0\nobj_info x\nelement camera 1\nproperty list uchar float pose\n"
      "property double f\nelement vertex 3\nproperty double x\nproperty float nx\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement nothing 4000000000\nelement face 1\nproperty uchar flag\n"
      "property list uchar uint vertex_index\nend_header\n"
      "2 1.5 2.5 560\n0 9 0 0 1 2 3\n+1 9 1e-50 0 255 0 0\n0 9 1 0 0 0 7\n1 3 0 1 2\n";
  const TriangleMesh mesh = parseMesh(text, "");
  ASSERT_EQ(mesh.vertices_mm.size(), 3u);
  EXPECT_EQ(mesh.vertices_mm[1], Eigen::Vector3f(1, 0, 0));
  ASSERT_EQ(mesh.colours.size(), 3u);
  EXPECT_EQ(mesh.colours[0], (Rgb8{1, 2, 3}));
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(MeshReader, ReadsObjWithColoursPolygonsTexturesAndIndicesFromTheEnd) {
  const TriangleMesh mesh = parseMesh(
      "# a square\nmtllib none.mtl\no square\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\n"
      "v 0 1 0 0.5 2 -1 # bright\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1 -1\n",
      "");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(mesh.colours.size(), 4u);
  EXPECT_EQ(mesh.colours[3], (Rgb8{128, 255, 0}));
}

TEST(MeshReader, ReadsSeveralSolidsOfOneStl) {
  const std::string one = asciiStl(tetrahedron());
  const TriangleMesh mesh = parseMesh(one + one, "");
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.vertices_mm.size(), 4u);
}

TEST(MeshReader, MergesStlCornersAtTheSamePlaceAlone) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices_mm[0].x() = -0.0f;
  TriangleMesh other = mesh;
  other.vertices_mm[0].x() = 0.0f;
  const std::string both = asciiStl(mesh) + asciiStl(other);
  EXPECT_EQ(parseMesh(both, "").vertices_mm.size(), 4u);
  other.vertices_mm[0].x() = 1e-6f;
  EXPECT_EQ(parseMesh(asciiStl(mesh) + asciiStl(other), "").vertices_mm.size(), 5u);
}

TEST(MeshReader, RefusesWhatIsMissingEmptyOrNoFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(readMesh(folder / "none.stl"), InputError);
  EXPECT_THROW(readMesh(folder.path()), InputError);
  put(folder / "empty.ply", "");
  EXPECT_THROW(readMesh(folder / "empty.ply"), InputError);
  std::filesystem::create_symlink(folder / "loop.stl", folder / "loop.stl");
  EXPECT_THROW(readMesh(folder / "loop.stl"), InputError);
  put(folder / "good.stl", binaryStl(tetrahedron()));
  EXPECT_EQ(readMesh(folder / "good.stl").triangles.size(), 4u);
}

TEST(MeshReader, RefusesEveryTruncationOfBinaryForms) {
  for (const Form& form : everyForm()) {
    if (form.name == "ascii.stl" || form.name == "ascii.ply" || form.name == "mesh.obj") continue;
    for (std::size_t length = 0; length < form.bytes.size(); ++length)
      EXPECT_THROW(parseMesh(form.bytes.substr(0, length), form.name), InputError)
          << form.name << " " << length;
  }
}

TEST(MeshReader, RefusesTruncatedTexts) {
  const std::string stl = asciiStl(tetrahedron()), ply = asciiPly(tetrahedron());
  for (std::size_t length = 0; length < stl.size() - std::strlen("endsolid made\n"); ++length)
    EXPECT_THROW(parseMesh(stl.substr(0, length), ""), InputError) << length;
  for (std::size_t length = 0; length < ply.size() - 2; ++length)  // the last digit is the file's
    EXPECT_THROW(parseMesh(ply.substr(0, length), ""), InputError) << length;
  EXPECT_TELLS(replaced(stl, "endsolid made\n", ""), "truncated");
}

TEST(MeshReader, SaysWhatIsWrongAndWhere) {
  const TriangleMesh mesh = tetrahedron();
  EXPECT_TELLS("hello", "neither STL, PLY nor OBJ");
  EXPECT_TELLS(std::string(200, 'x'), "as a binary STL it should have");
  EXPECT_TELLS("solid nothing\nendsolid\n", "no triangles");
  EXPECT_TELLS(replaced(asciiStl(mesh), "1.5", "one"), "line 5: found \"one\"");
  EXPECT_TELLS(replaced(asciiStl(mesh), "endloop", "vertex"), "`endloop` is expected");
  EXPECT_TELLS(replaced(asciiStl(mesh), "1.5", "nan"), "vertex 1 has a coordinate");
  EXPECT_TELLS(replaced(obj(mesh), "1.5", "1e99"), "vertex 1 has a coordinate");
  EXPECT_TELLS(replaced(obj(mesh), "1.5", "1e34"), "vertex 1 lies more than 10 km");
  EXPECT_TELLS(replaced(obj(mesh), "f 1 2 3", "f 1 2"), "line 5: a face has 2 corners");
  EXPECT_TELLS(replaced(obj(mesh), "f 1 2 3", "f 1 2 -5"), "vertex -5");
  EXPECT_TELLS(replaced(obj(mesh), "f 1 2 3", "f 1 2 5"), "names vertex 4");
  EXPECT_TELLS(replaced(obj(mesh), "v 1.5 0 0", "v 1.5 0"), "2 coordinates");
  EXPECT_TELLS("v 1 2 3\nv 1 2 4\n", "a cloud of points?");
  EXPECT_TELLS(replaced(asciiPly(mesh), "ascii", "morse"), "\"morse\"");
  EXPECT_TELLS(replaced(asciiPly(mesh), "float x", "string x"), "a PLY type is expected");
  EXPECT_TELLS(replaced(asciiPly(mesh), "float x", "float a"), "no x, y, z");
  EXPECT_TELLS(replaced(asciiPly(mesh), "vertex_indices", "corners"), "no list vertex_indices");
  EXPECT_TELLS(replaced(asciiPly(mesh), "3 0 1 2", "3 0 1 9"), "triangle 0 names vertex 9");
  EXPECT_TELLS(replaced(asciiPly(mesh), "3 0 1 2", "3 0 1 -1"), "names vertex -1");
  EXPECT_TELLS(replaced(asciiPly(mesh), "3 0 1 2", "-3 0 1 2"), "no whole length");
  EXPECT_TELLS(replaced(asciiPly(mesh), "element vertex 4", "element vertex 4000000000"),
               "promises 4000000000");
  EXPECT_TELLS(replaced(asciiPly(mesh), "end_header", "ende"), "in a PLY header");
}

}  // namespace
}  // namespace softscope::test
