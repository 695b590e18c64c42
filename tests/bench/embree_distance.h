// tests/bench/embree_distance.h: distances by Embree's trees, to compare with.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/triangle_mesh.h"

namespace softscope::test {

class EmbreeDistance {
 public:
  virtual ~EmbreeDistance() = default;
  /// Unsigned, mm; may be called from several threads.
  virtual double distance(const Eigen::Vector3f& point_mm) const = 0;
};

/// Nothing where this build has no Embree.
std::unique_ptr<EmbreeDistance> makeEmbreeDistance(const TriangleMesh& mesh);

}  // namespace softscope::test
