// eval/simulation/tissue/organ_mesh.h: procedural organ mesh.
#pragma once

#include <cstdint>

#include "core/triangle_mesh.h"

namespace softscope {

/// Closed, smooth, lobed body with shallow folds, centred at the origin, mm.
struct OrganOptions {
  double length_mm = 60;    // longest axis; the others are 0.88 and 0.6 of it
  int cells_per_side = 58;  // per face of the cube: about 6 n^2 vertices, 20,000 by default
  double lobe_mm = 3.0;     // height of lobes
  double fold_mm = 1.4;     // depth of folds

  /// Throws OptionError.
  void validate() const;
};

TriangleMesh makeOrganMesh(const OrganOptions& options, std::uint64_t seed);

}  // namespace softscope
