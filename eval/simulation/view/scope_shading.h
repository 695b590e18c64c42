// eval/simulation/view/scope_shading.h: shading of wet tissue under the scope's light.
#pragma once

#include <Eigen/Core>

namespace softscope {

struct LightOptions {
  double x_mm = 0;      // relative to the centre between the cameras: right,
  double y_mm = -3;     // down,
  double z_mm = 0;      // forward
  double beam = 1.5;    // exponent of the cosine fall-off of the beam; 0: isotropic
  double relief = 1.0;  // strength of fine bumps

  /// Throws OptionError.
  void validate() const;
};

/// Position on the tissue, in the left camera frame.
struct LitPoint {
  Eigen::Vector3f position_mm;
  Eigen::Vector3f normal;  // unit length
  Eigen::Vector3f albedo;
  float wetness = 0;
};

/// Light source, normalised such that white tissue facing it at `reference_mm` has radiance 1.
class ScopeLight {
 public:
  ScopeLight(const LightOptions& options, double baseline_mm, double reference_mm);

  /// Linear red, green, blue from `point` towards `eye_mm`: diffuse reflection
  /// with inverse-square attenuation, and two glossy lobes (Blinn 1977).
  Eigen::Vector3f shade(const LitPoint& point, const Eigen::Vector3f& eye_mm) const;

  /// The same for brushed steel.
  Eigen::Vector3f shadeSteel(const Eigen::Vector3f& position_mm, const Eigen::Vector3f& normal,
                             const Eigen::Vector3f& eye_mm) const;

 private:
  Eigen::Vector3f position_mm_;
  float reference2_mm2_;
  float beam_;
};

}  // namespace softscope
