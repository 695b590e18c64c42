#include "eval/simulation/camera/scope_event.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "eval/simulation/camera/camera_settings.h"
#include "eval/simulation/noise/noise.h"

namespace softscope {
namespace {

constexpr double kRamp_s = 0.25;
constexpr double kWithdrawn = 1.5;  // in units of the distance to the tissue
constexpr double kBurst = 6;        // smoke density of a burst: opaque
constexpr std::uint32_t kEventSeed = 91;
constexpr float kPatchesPerPicture = 3.0F;
const Eigen::Vector3f kTissueOnLens(0.16F, 0.03F, 0.02F), kGauze(0.55F, 0.5F, 0.46F);

double easeInOut(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Mixes in what covers the lens: out of focus, so only large patches.
void mixIn(const Eigen::Vector3f& colour, float share, double time_s, int camera,
           Raster<Eigen::Vector3f>& light) {
  const float scale = kPatchesPerPicture / float(light.width_px);
  const auto time = static_cast<float>(time_s);
  parallelRows(light.height_px, [&](int v) {
    for (int u = 0; u < light.width_px; ++u) {
      const Eigen::Vector3f at(scale * float(u) + 1.7F * time, scale * float(v),
                               5.0F * float(camera));
      const float patch = 0.8F + 0.4F * fractalNoise(at, 2, kEventSeed);
      light.at(u, v) = (1 - share) * light.at(u, v) + share * patch * colour;
    }
  });
}

}  // namespace

void ScopeEventOptions::validate() const { requireAllowed(*this); }

double ScopeEventOptions::shareAt(double time_s) const {
  if (!there()) return 0;
  const double ramp_s = std::min(kRamp_s, length_s / 4);
  return std::min(easeInOut((time_s - start_s) / ramp_s),
                  easeInOut((start_s + length_s - time_s) / ramp_s));
}

Eigen::Isometry3d ScopeEventOptions::motionAt(double time_s, double distance_mm) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (kind != "withdraw") return motion;
  const double back = easeInOut((time_s - start_s) / length_s);  // path to the new position
  motion.translate(
      Eigen::Vector3d(back * return_mm, 0, -kWithdrawn * distance_mm * shareAt(time_s)));
  motion.rotate(Eigen::AngleAxisd(back * return_deg * M_PI / 180, Eigen::Vector3d::UnitZ()));
  return motion;
}

double ScopeEventOptions::smokeAt(double time_s) const {
  return kind == "smoke" ? kBurst * shareAt(time_s) : 0;
}

void addEvent(Raster<Eigen::Vector3f>& light, const ScopeEventOptions& event, double time_s,
              int camera) {
  const auto share = static_cast<float>(event.shareAt(time_s));
  if (share <= 0) return;
  if (event.kind == "withdraw") {
    for (Eigen::Vector3f& value : light.values) value *= 1 - share;
  } else if (event.kind == "cover") {
    mixIn(kTissueOnLens, share, 0, camera, light);
  } else if (event.kind == "wipe") {
    mixIn(kGauze, share, time_s, camera, light);
  }
}

}  // namespace softscope
