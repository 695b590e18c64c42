// toolkit/simulation/simulate_inputs.h: input files of a simulation.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "toolkit/simulation/simulate_options.h"

namespace softscope {

/// Closed surface, with the repaired and the remaining defects of its file.
struct OrganFile {
  TriangleMesh mesh;
  std::vector<std::string> warnings;
};

/// Built-in organ, or that of `organ.mesh` (STL, PLY,
/// OBJ, VTP or VTK), repaired. Throws InputError.
OrganFile readOrgan(const SimulateOptions& options);

/// Reads the image of `texture.picture`, if set, into the options of the simulation.
/// Throws InputError, and OptionError for an unsuitable `texture.picture_mm`.
void readTexture(SimulateOptions& options);

}  // namespace softscope
