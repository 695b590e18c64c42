// eval/simulation/tissue/tissue_deformation.h: breathing, heartbeat and pushes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/simulation/tissue/arap_pushes.h"

namespace softscope {

/// A motion that comes back to rest after every period; amplitude 0 switches it off.
struct PeriodicMotion {
  double amplitude_mm = 0;
  double period_s = 1;
};

struct DeformationOptions {
  PeriodicMotion breathing{2.0, 3.5};
  PeriodicMotion heartbeat{0.8, 0.9};
  /// Pushes follow one another: each moves a random place by 0.8 to 1.2 amplitudes within a period.
  PeriodicMotion push{2.5, 0.8};
  /// "gaussian": falls off smoothly, and is let go over the two periods after. "arap": from the
  /// state that the last push left, spread as rigidly as possible, and never let go.
  std::string push_kind = "gaussian";
  double push_spread_mm = 9;  // of the fall-off around the place

  /// Throws OptionError.
  void validate() const;
};

/// Where each vertex is at any time; vertex i is the same tissue for ever. At 0 s the tissue rests.
class TissueDeformation {
 public:
  /// Hearts beat and pushes land around `focus_mm`, where the scope looks. Same frame as the mesh.
  TissueDeformation(const TriangleMesh& rest_mesh, const Eigen::Vector3f& focus_mm,
                    const DeformationOptions& options, std::uint64_t seed);

  /// Pushes of kind "arap" need those before them: frames in order are the fast ones.
  std::vector<Eigen::Vector3f> verticesAt(double time_s);

 private:
  struct Push {
    std::int32_t vertex;
    Eigen::Vector3f site_mm;
    Eigen::Vector3f shift_mm;  // at its height
  };
  Push pushNumber(int number) const;
  std::vector<Push> pushesAt(double time_s) const;  // those at work, shifted as far as they are now
  std::vector<Eigen::Vector3f> restingAt(
      double time_s);  // pushed, but neither breathing nor beating
  const std::vector<Eigen::Vector3f>& stateAfter(int pushes);

  DeformationOptions options_;
  std::uint64_t seed_;
  std::vector<Eigen::Vector3f> rest_mm_;
  std::vector<Eigen::Vector3f> breathing_mm_;        // at full breath
  std::vector<Eigen::Vector3f> heartbeat_mm_;        // at the height of a beat
  std::vector<std::int32_t> push_sites_;             // vertices that may be pushed
  std::unique_ptr<ArapPushes> arap_;                 // where pushes are of this kind
  int oldest_ = 0;                                   // pushes behind states_.front()
  std::deque<std::vector<Eigen::Vector3f>> states_;  // each one push further
};

}  // namespace softscope
