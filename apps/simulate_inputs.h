// apps/simulate_inputs.h: what a simulation is made of, from files.
#pragma once

#include "apps/simulate_options.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// The built-in organ, or the one that `organ.mesh` names (STL, PLY, OBJ, VTP or VTK), repaired;
/// what was repaired and what couldn't be is logged. Throws InputError.
TriangleMesh readOrgan(const SimulateOptions& options);

/// Reads the picture that `texture.picture` names, if any, into the simulation's options. Throws
/// InputError, and OptionError where `texture.picture_mm` doesn't suit it.
void readTexture(SimulateOptions& options);

}  // namespace softscope
