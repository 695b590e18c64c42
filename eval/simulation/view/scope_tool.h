// eval/simulation/view/scope_tool.h: steel
// instrument from the side that occludes tissue.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/image.h"

namespace softscope {

struct ScopeToolOptions {
  double radius_mm = 0;     // radius of the shaft; 0: no instrument
  double side_deg = 205;    // direction in the image: 0 right, 90 below, 180 left
  double reach = 0.25;      // position of the tip, from the image centre (0) to the border (1)
  double height_mm = 8;     // height of the tip above the target tissue
  double amplitude_mm = 4;  // oscillation along its shaft
  double period_s = 2.5;

  /// Throws OptionError.
  void validate() const;
  bool there() const { return radius_mm > 0; }
};

/// Capsule: a shaft, or a jaw.
struct Capsule {
  Eigen::Vector3f from_mm, to_mm;
  float radius_mm;
};

struct ToolHit {
  float distance;  // in units of the direction length; for direction z = 1 the depth
  Eigen::Vector3f normal;
};

/// Shaft and two jaws at one time, in the left camera frame.
class ScopeTool {
 public:
  /// The tissue in the image centre is at `distance_mm`.
  ScopeTool(const ScopeToolOptions& options, const PinholeCamera& left, double distance_mm,
            double time_s);

  /// First intersection of a ray before `limit`.
  std::optional<ToolHit> meet(const Eigen::Vector3f& origin_mm, const Eigen::Vector3f& direction,
                              float limit) const;

  bool there() const { return !parts_.empty(); }

 private:
  std::vector<Capsule> parts_;
};

}  // namespace softscope
