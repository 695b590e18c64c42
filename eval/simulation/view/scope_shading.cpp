// eval/simulation/view/scope_shading.cpp: shading of one surface point by one light.
#include "eval/simulation/view/scope_shading.h"

#include <algorithm>
#include <cmath>

#include "eval/simulation/view/view_settings.h"

namespace softscope {
namespace {

// Subsurface scattering around the terminator, strongest for red.
const Eigen::Array3f kSeep(0.28F, 0.12F, 0.10F);
const Eigen::Vector3f kSteel(0.30F, 0.31F, 0.33F);
constexpr float kBrightest = 4;       // limit near the scope, relative to that at the tissue
constexpr float kReflected = 0.028F;  // water at normal incidence

/// x^(2^doublings), by multiplication only: fast and portable.
float powerOfTwo(float x, int doublings) {
  for (int i = 0; i < doublings; ++i) x *= x;
  return x;
}

/// Energy-normalised Blinn lobe with exponent 2^doublings.
float lobe(float cosine, int doublings) {
  return (float(1 << doublings) + 8) / 8 * powerOfTwo(cosine, doublings);
}

}  // namespace

void LightOptions::validate() const { requireAllowed(*this); }

ScopeLight::ScopeLight(const LightOptions& options, double baseline_mm, double reference_mm)
    : position_mm_(float(options.x_mm + 0.5 * baseline_mm), float(options.y_mm),
                   float(options.z_mm)),
      reference2_mm2_(float(reference_mm * reference_mm)),
      beam_(float(options.beam)) {
  options.validate();
}

Eigen::Vector3f ScopeLight::shade(const LitPoint& point, const Eigen::Vector3f& eye_mm) const {
  const Eigen::Vector3f to_light = position_mm_ - point.position_mm;
  const float distance2 = std::max(to_light.squaredNorm(), 1.0F);
  const Eigen::Vector3f light = to_light / std::sqrt(distance2);
  const Eigen::Vector3f eye = (eye_mm - point.position_mm).normalized();
  const float axial = std::max(-light.z(), 1e-4F);  // the optical axis of the light is +z
  const float strength = reference2_mm2_ / distance2 * (beam_ > 0 ? std::pow(axial, beam_) : 1.0F);

  const float facing = point.normal.dot(light);
  const Eigen::Array3f diffuse = ((facing + kSeep) / (1 + kSeep)).max(0.0F);
  Eigen::Array3f sent = point.albedo.array() * diffuse;
  if (facing > 0 && point.wetness > 0) {
    const float halfway = std::max(0.0F, point.normal.dot((light + eye).normalized()));
    const float grazing = 1 - std::clamp(point.normal.dot(eye), 0.0F, 1.0F);
    const float reflected = kReflected + 0.35F * grazing * powerOfTwo(grazing, 2);
    sent +=
        point.wetness * reflected * facing * (0.75F * lobe(halfway, 9) + 0.6F * lobe(halfway, 5));
  }
  return (strength * sent).matrix();
}

Eigen::Vector3f ScopeLight::shadeSteel(const Eigen::Vector3f& position_mm,
                                       const Eigen::Vector3f& normal,
                                       const Eigen::Vector3f& eye_mm) const {
  const Eigen::Vector3f to_light = position_mm_ - position_mm;
  const float distance2 = std::max(to_light.squaredNorm(), 1.0F);
  const Eigen::Vector3f light = to_light / std::sqrt(distance2);
  const float facing = std::max(0.0F, normal.dot(light));
  const float halfway =
      std::max(0.0F, normal.dot((light + (eye_mm - position_mm).normalized()).normalized()));
  const float strength = std::min(reference2_mm2_ / distance2, kBrightest);
  const float gloss = 0.35F * powerOfTwo(halfway, 3) + 1.6F * powerOfTwo(halfway, 6);
  return strength * ((0.06F + 0.7F * facing) * kSteel + gloss * Eigen::Vector3f::Ones());
}

}  // namespace softscope
