// eval/simulation/tissue/organ_mesh.h: procedural organ mesh.
#pragma once

#include <cstdint>

#include "core/triangle_mesh.h"

namespace softscope {

/// A closed, smooth, lobed body with shallow folds around the origin, mm.
struct OrganOptions {
  double length_mm = 60;    // of the longest axis; the others are 0.88 and 0.6 of it
  int cells_per_side = 58;  // of each of the cube's faces: about 6 n^2 vertices, 20,000 by default
  double lobe_mm = 3.0;     // how far lobes stand out
  double fold_mm = 1.4;     // how deep folds are

  /// Throws OptionError.
  void validate() const;
};

TriangleMesh makeOrganMesh(const OrganOptions& options, std::uint64_t seed);

}  // namespace softscope
