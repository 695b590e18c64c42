// eval/simulation/view/scope_tool.h: a steel instrument that comes in from the side and hides
// tissue.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/image.h"

namespace softscope {

struct ScopeToolOptions {
  double radius_mm = 0;     // of the shaft; 0: no instrument
  double side_deg = 205;    // where it comes from in the image: 0 right, 90 below, 180 left
  double reach = 0.25;      // its tip, from the image's middle (0) to the border (1)
  double height_mm = 8;     // of the tip above the tissue that the scope looks at
  double amplitude_mm = 4;  // it moves to and fro along its shaft
  double period_s = 2.5;

  /// Throws OptionError.
  void validate() const;
  bool there() const { return radius_mm > 0; }
};

/// A ball drawn along a line: a shaft, or a jaw.
struct Capsule {
  Eigen::Vector3f from_mm, to_mm;
  float radius_mm;
};

struct ToolHit {
  float distance;  // in lengths of the ray's direction; with direction z = 1 the depth
  Eigen::Vector3f normal;
};

/// Shaft and two jaws at one moment, in the left camera's frame.
class ScopeTool {
 public:
  /// The tissue in the middle of the image is `distance_mm` away.
  ScopeTool(const ScopeToolOptions& options, const PinholeCamera& left, double distance_mm,
            double time_s);

  /// What a ray meets first, nearer than `limit`.
  std::optional<ToolHit> meet(const Eigen::Vector3f& origin_mm, const Eigen::Vector3f& direction,
                              float limit) const;

  bool there() const { return !parts_.empty(); }

 private:
  std::vector<Capsule> parts_;
};

}  // namespace softscope
