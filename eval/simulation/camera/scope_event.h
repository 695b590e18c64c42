// eval/simulation/camera/scope_event.h: simulated events that hide the tissue from the scope.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "core/raster.h"

namespace softscope {

/// Ground truth stays geometric: depth, tracks and their visibility are those of the tissue behind.
struct ScopeEventOptions {
  std::string kind = "none";  // none, withdraw (into the dark trocar and back), cover (tissue on
                              // the lens), wipe (gauze over the lens), smoke (a dense burst)
  double start_s = 1;
  double length_s = 2;    // from the first frame that shows it to the last
  double return_mm = 0;   // withdraw: the scope comes back this far to the right, …
  double return_deg = 0;  // … turned by this about its axis

  /// Throws OptionError.
  void validate() const;
  bool there() const { return kind != "none"; }
  /// 0: not there; 1: nothing else to see. Rises and falls within a quarter of a second.
  double shareAt(double time_s) const;
  /// undisturbed_from_now: how the event moves the left camera.
  Eigen::Isometry3d motionAt(double time_s, double distance_mm) const;
  /// That it adds to the air's smoke.
  double smokeAt(double time_s) const;
};

/// Changes the linear `light` of one camera as `event` does. `camera`: 0 left, 1 right; both see
/// different parts of what lies on their lenses.
void addEvent(Raster<Eigen::Vector3f>& light, const ScopeEventOptions& event, double time_s,
              int camera);

}  // namespace softscope
