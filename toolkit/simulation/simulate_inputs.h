// toolkit/simulation/simulate_inputs.h: input files of a simulation.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

/// A closed surface, and what was repaired of its file or couldn't be.
struct OrganFile {
  TriangleMesh mesh;
  std::vector<std::string> warnings;
};

/// The built-in organ, or the one that `organ.mesh` names (STL, PLY, OBJ, VTP or VTK), repaired.
/// Throws InputError.
OrganFile readOrgan(const SimulateOptions& options);

/// Reads the image that `texture.picture` names, if any, into the simulation's options. Throws
/// InputError, and OptionError where `texture.picture_mm` doesn't suit it.
void readTexture(SimulateOptions& options);

}  // namespace softscope
