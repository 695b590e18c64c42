// eval/simulation/camera/camera_path.cpp: sums of sines, zero at 0 s.
#include "eval/simulation/camera/camera_path.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "eval/simulation/camera/camera_settings.h"
#include "eval/simulation/noise/random.h"

namespace softscope {
namespace {

constexpr double kJerk_s = 0.25;           // duration of a quick movement
constexpr double kTremorRadPerMm = 0.004;  // rotation of the scope with the tremor of the hand

/// x right, y down, z towards the tissue; y of the organ is up.
Eigen::Matrix3d orientation(const Eigen::Vector3d& to_scope) {
  const Eigen::Vector3d forward = -to_scope;
  const Eigen::Vector3d up =
      std::abs(to_scope.y()) > 0.99 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  Eigen::Matrix3d axes;
  axes.col(2) = forward;
  axes.col(0) = forward.cross(up).normalized();
  axes.col(1) = forward.cross(axes.col(0));
  return axes;
}

Eigen::Isometry3d moved(double x_mm, double y_mm, double z_mm) {
  return Eigen::Isometry3d(Eigen::Translation3d(x_mm, y_mm, z_mm));
}

Eigen::Isometry3d turned(double pitch_rad, double yaw_rad) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()));
}

}  // namespace

void CameraPathOptions::validate() const {
  requireAllowed(*this);
  require(amplitude_mm <= distance_mm, "camera.amplitude_mm", amplitude_mm,
          "must be at most camera.distance_mm");
}

Eigen::Vector3d scopeDirection(const CameraPathOptions& options) {
  const double azimuth_rad = options.azimuth_deg * M_PI / 180;
  const double elevation_rad = options.elevation_deg * M_PI / 180;
  return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
          std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

CameraPath::CameraPath(const CameraPathOptions& options, const Eigen::Vector3d& target_body_mm,
                       double baseline_mm, std::uint64_t seed)
    : options_(options), baseline_mm_(baseline_mm), seed_(seed) {
  options.validate();
  const Eigen::Vector3d to_scope = scopeDirection(options);
  body_from_start_ = Eigen::Isometry3d::Identity();
  body_from_start_.linear() = orientation(to_scope);
  body_from_start_.translation() = target_body_mm + options.distance_mm * to_scope;
  SeededRandom random(seed);
  for (int i = 0; i < 6; ++i) {
    tremor_hz_[i] = random.uniform(5, 11);
    tremor_share_[i] = random.uniform(-1, 1);
  }
}

Eigen::Isometry3d CameraPath::wayAt(double time_s) const {
  const double phase_rad = 2 * M_PI * time_s / options_.period_s;
  const double across = std::sin(phase_rad), along = 0.5 * std::sin(2 * phase_rad);
  const double a_mm = options_.amplitude_mm, d_mm = options_.distance_mm;
  if (options_.path == "sweep") {  // rotated half-way back to the target
    const double half_rad = 0.5 * a_mm / d_mm;
    return moved(a_mm * across, a_mm * along, 0) * turned(half_rad * along, -half_rad * across);
  }
  if (options_.path == "orbit")
    return moved(0, 0, d_mm) * turned(a_mm / d_mm * along, -a_mm / d_mm * across) *
           moved(0, 0, -d_mm);
  if (options_.path == "jerk") return jerkAt(time_s);
  return Eigen::Isometry3d::Identity();
}

/// Position after each jerk; number 0 is the start.
Eigen::Vector2d CameraPath::restNumber(int number) const {
  if (number <= 0) return Eigen::Vector2d::Zero();
  SeededRandom random(seed_ + 16 + static_cast<std::uint64_t>(number));
  const double angle_rad = random.uniform(0, 2 * M_PI), share = random.uniform(0.5, 1);
  return options_.amplitude_mm * share * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
}

/// Once per period a quick movement to another
/// position, rotated half-way back to the target.
Eigen::Isometry3d CameraPath::jerkAt(double time_s) const {
  const int number = static_cast<int>(std::floor(time_s / options_.period_s));
  const double age_s = time_s - number * options_.period_s;
  const double t = std::min(1.0, age_s / std::min(kJerk_s, options_.period_s));
  const double share = t * t * (3 - 2 * t);
  const Eigen::Vector2d at_mm =
      restNumber(number - 1) + share * (restNumber(number) - restNumber(number - 1));
  const double half_per_mm = 0.5 / options_.distance_mm;
  return moved(at_mm.x(), at_mm.y(), 0) * turned(half_per_mm * at_mm.y(), -half_per_mm * at_mm.x());
}

Eigen::Isometry3d CameraPath::tremorAt(double time_s) const {
  Eigen::Array<double, 6, 1> wave;
  for (int i = 0; i < 6; ++i)
    wave[i] = options_.tremor_mm * tremor_share_[i] * std::sin(2 * M_PI * tremor_hz_[i] * time_s);
  return moved(wave[0], wave[1], wave[2]) *
         turned(kTremorRadPerMm * wave[3], kTremorRadPerMm * wave[4]);
}

Eigen::Isometry3d CameraPath::bodyFromLeft(double time_s) const {
  return body_from_start_ * wayAt(time_s) * tremorAt(time_s) * moved(-0.5 * baseline_mm_, 0, 0);
}

}  // namespace softscope
