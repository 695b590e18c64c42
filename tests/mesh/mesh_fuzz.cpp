// tests/mesh/mesh_fuzz.cpp: surfaces from STL, PLY and OBJ.
#include "fuzz/fuzz_target.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace softscope;
  using namespace softscope::test;
  const auto mesh = answerOf([&] { return parseMesh(textOf(data, size), "fuzz"); });
  if (!mesh) return 0;
  const MeshCheck check = checkMesh(*mesh);
  mustHold(check.triangle_count > 0 && check.components > 0);
  mustHold(mesh->colours.empty() || mesh->colours.size() == mesh->vertices_mm.size());
  return 0;
}
