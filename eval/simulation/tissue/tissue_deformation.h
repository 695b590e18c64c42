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

/// Periodic motion from rest; amplitude 0: off.
struct PeriodicMotion {
  double amplitude_mm = 0;
  double period_s = 1;
};

struct DeformationOptions {
  PeriodicMotion breathing{2.0, 3.5};
  PeriodicMotion heartbeat{0.8, 0.9};
  /// Successive pushes, each at a random position by 0.8 to 1.2 amplitudes within one period.
  PeriodicMotion push{2.5, 0.8};
  /// "gaussian": smooth decay around the position, released over the next two periods. "arap":
  /// from the state after the last push, propagated as rigidly as possible, not released.
  std::string push_kind = "gaussian";
  double push_spread_mm = 9;  // decay length around the position

  /// Throws OptionError.
  void validate() const;
};

/// Positions of all vertices at any time; vertex i is always the same tissue. At rest at 0 s.
class TissueDeformation {
 public:
  /// Heartbeat and pushes are centred at `focus_mm`, the view target. In the frame of the mesh.
  TissueDeformation(const TriangleMesh& rest_mesh, const Eigen::Vector3f& focus_mm,
                    const DeformationOptions& options, std::uint64_t seed);

  /// Pushes of kind "arap" depend on the earlier ones: ascending times are fast.
  std::vector<Eigen::Vector3f> verticesAt(double time_s);

 private:
  struct Push {
    std::int32_t vertex;
    Eigen::Vector3f site_mm;
    Eigen::Vector3f shift_mm;  // maximum displacement
  };
  Push pushNumber(int number) const;
  std::vector<Push> pushesAt(double time_s) const;  // active pushes with their current displacement
  std::vector<Eigen::Vector3f> restingAt(
      double time_s);  // with pushes, without breathing and heartbeat
  const std::vector<Eigen::Vector3f>& stateAfter(int pushes);

  DeformationOptions options_;
  std::uint64_t seed_;
  std::vector<Eigen::Vector3f> rest_mm_;
  std::vector<Eigen::Vector3f> breathing_mm_;        // at maximum inspiration
  std::vector<Eigen::Vector3f> heartbeat_mm_;        // at the peak of a beat
  std::vector<std::int32_t> push_sites_;             // vertices available for pushes
  std::unique_ptr<ArapPushes> arap_;                 // for pushes of this kind
  int oldest_ = 0;                                   // number of pushes before states_.front()
  std::deque<std::vector<Eigen::Vector3f>> states_;  // one more push each
};

}  // namespace softscope
