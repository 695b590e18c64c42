// eval/simulation/camera/camera_path.h: motion of the scope.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

namespace softscope {

struct CameraPathOptions {
  std::string path = "sweep";  // still, sweep (to and fro), orbit (around the tissue),
                               // jerk (quick movements to other positions at intervals)
  double amplitude_mm = 4;     // of the path, measured at the scope
  double period_s = 6;
  double tremor_mm = 0.15;   // of the hand, 5 to 11 Hz; 0: off
  double distance_mm = 40;   // from the scope to the tissue in the image centre
  double azimuth_deg = 0;    // direction from the organ to the scope: about its y axis,
  double elevation_deg = 0;  // then upwards; 0, 0 looks along -z

  /// Throws OptionError.
  void validate() const;
};

/// Unit vector from the organ to the scope.
Eigen::Vector3d scopeDirection(const CameraPathOptions& options);

/// Poses around a target on the tissue, both in the frame of the organ ("body").
class CameraPath {
 public:
  CameraPath(const CameraPathOptions& options, const Eigen::Vector3d& target_body_mm,
             double baseline_mm, std::uint64_t seed);

  /// p_body = result * p_left.
  Eigen::Isometry3d bodyFromLeft(double time_s) const;

 private:
  Eigen::Isometry3d wayAt(double time_s) const;  // start_from_now, about the initial rig centre
  Eigen::Isometry3d jerkAt(double time_s) const;
  Eigen::Vector2d restNumber(int number) const;
  Eigen::Isometry3d tremorAt(double time_s) const;

  CameraPathOptions options_;
  Eigen::Isometry3d body_from_start_;  // rig centre, at rest
  double baseline_mm_;
  std::uint64_t seed_;
  Eigen::Array<double, 6, 1> tremor_hz_, tremor_share_;
};

}  // namespace softscope
