// eval/simulation/camera/scope_event.h: simulated events that hide the tissue from the scope.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "core/raster.h"

namespace softscope {

/// Ground truth remains geometric: depth, tracks and visibility of the tissue behind.
struct ScopeEventOptions {
  std::string kind = "none";  // none, withdraw (into the dark trocar and back), cover (tissue
                              // on the lens), wipe (gauze over the lens), smoke (dense burst)
  double start_s = 1;
  double length_s = 2;    // from the first affected frame to the last
  double return_mm = 0;   // withdraw: lateral offset after the return, to the right
  double return_deg = 0;  // withdraw: rotation about the axis after the return

  /// Throws OptionError.
  void validate() const;
  bool there() const { return kind != "none"; }
  /// 0: inactive; 1: tissue fully hidden. Ramps of a quarter of a second.
  double shareAt(double time_s) const;
  /// undisturbed_from_now: motion of the left camera by the event.
  Eigen::Isometry3d motionAt(double time_s, double distance_mm) const;
  /// Additional smoke in the air.
  double smokeAt(double time_s) const;
};

/// Applies `event` to the linear `light` of one camera. `camera`:
/// 0 left, 1 right; both have different patterns on their lenses.
void addEvent(Raster<Eigen::Vector3f>& light, const ScopeEventOptions& event, double time_s,
              int camera);

}  // namespace softscope
