// eval/simulation/texture/vessel_growth.h: arteries and veins that branch over a surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Straight segment of a vessel on the rest surface.
struct VesselSegment {
  Eigen::Vector3f begin_mm, end_mm;
  float begin_radius_mm = 0, end_radius_mm = 0;
  bool is_vein = false;
};

struct VesselOptions {
  double trunk_spacing_mm = 11;  // approximate distance of neighbouring trunks
  double trunk_radius_mm = 0.5;  // of the widest trunk

  /// Throws OptionError.
  void validate() const;
};

/// Trunks start at random positions; arteries and veins run in parallel, wind,
/// taper and branch (radii by Murray's law) down to capillaries of 0.035 mm.
std::vector<VesselSegment> growVessels(const TriangleMesh& rest_mesh, const VesselOptions& options,
                                       std::uint64_t seed);

}  // namespace softscope
