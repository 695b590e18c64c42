// eval/simulation/view/scope_shading.h: shading of wet tissue under the scope's light.
#pragma once

#include <Eigen/Core>

namespace softscope {

struct LightOptions {
  double x_mm = 0;      // from the middle between the cameras: right,
  double y_mm = -3;     // down,
  double z_mm = 0;      // forward
  double beam = 1.5;    // power of the cosine by which the beam fades to its rim; 0: all round
  double relief = 1.0;  // how strongly fine bumps bend the light

  /// Throws OptionError.
  void validate() const;
};

/// A place on the tissue, in the left camera's frame.
struct LitPoint {
  Eigen::Vector3f position_mm;
  Eigen::Vector3f normal;  // unit length
  Eigen::Vector3f albedo;
  float wetness = 0;
};

/// The light, with strength such that white tissue that faces it at `reference_mm` sends back 1.
class ScopeLight {
 public:
  ScopeLight(const LightOptions& options, double baseline_mm, double reference_mm);

  /// Linear red, green, blue that leave `point` towards `eye_mm`: soft diffuse light with the
  /// inverse square of the distance, and two glossy lobes (Blinn 1977).
  Eigen::Vector3f shade(const LitPoint& point, const Eigen::Vector3f& eye_mm) const;

  /// The same of brushed steel.
  Eigen::Vector3f shadeSteel(const Eigen::Vector3f& position_mm, const Eigen::Vector3f& normal,
                             const Eigen::Vector3f& eye_mm) const;

 private:
  Eigen::Vector3f position_mm_;
  float reference2_mm2_;
  float beam_;
};

}  // namespace softscope
