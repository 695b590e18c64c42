// toolkit/simulation/simulate_inputs.cpp: checks of meshes and images before the simulation.
#include "toolkit/simulation/simulate_inputs.h"

#include "core/error.h"
#include "io/images/image_reader.h"
#include "io/text/message.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_repair.h"
#include "toolkit/comparison/compare_inputs.h"

namespace softscope {
namespace {

constexpr int kLeastTexturePx = 32;

}  // namespace

OrganFile readOrgan(const SimulateOptions& options) {
  if (options.builtinOrgan())
    return {makeOrganMesh(options.simulation.organ,
                          static_cast<std::uint64_t>(options.simulation.seed)),
            {}};
  TriangleMesh mesh = readSurfaceOrPoints(
      options.organ, options.organ_unit_mm > 0 ? options.organ_unit_mm : kUnitOfFile);
  if (mesh.triangles.empty())
    throw InputError(
        shown(options.organ) +
        ": contains points without triangles, but a simulation needs surfaces; give a mesh");
  std::vector<std::string> warnings;
  RepairedMesh repaired = repairMesh(std::move(mesh), shown(options.organ));
  for (const std::string& repair : repaired.repairs)
    warnings.push_back(shown(options.organ) + ": " + repair);
  for (const std::string& warning : meshWarnings(checkMesh(repaired.mesh), "--set organ.unit_mm"))
    warnings.push_back(shown(options.organ) + ": " + warning);
  return {std::move(repaired.mesh), std::move(warnings)};
}

void readTexture(SimulateOptions& options) {
  if (options.texture.empty()) return;
  ColourImage picture = readColourImage(options.texture);
  if (picture.width_px < kLeastTexturePx || picture.height_px < kLeastTexturePx)
    throw InputError(say(shown(options.texture), ": is ", picture.width_px, " x ",
                         picture.height_px, " px, but a texture needs ", kLeastTexturePx, " x ",
                         kLeastTexturePx, " or more; give a larger photograph of tissue"));
  options.simulation.texture.picture = std::move(picture);
  options.simulation.texture.validate();
}

}  // namespace softscope
