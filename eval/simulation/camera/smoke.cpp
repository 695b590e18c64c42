// eval/simulation/camera/smoke.cpp: one layer of fractal noise, lit by the scope.
#include "eval/simulation/camera/smoke.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "eval/simulation/noise/noise.h"

namespace softscope {
namespace {

constexpr std::uint32_t kSmokeSeed = 77;
constexpr float kPuffsPerPicture = 2.4F;  // across the image width
constexpr float kThickness = 1.3F;        // mean optical thickness of the cloud
const Eigen::Vector3f kGrey(0.28F, 0.275F, 0.27F);

}  // namespace

void addSmoke(Raster<Eigen::Vector3f>& light, double smoke, double time_s, double shift_px) {
  if (smoke <= 0) return;
  const float scale = kPuffsPerPicture / float(light.width_px);
  const auto time = static_cast<float>(time_s), shift = static_cast<float>(shift_px);
  parallelRows(light.height_px, [&](int v) {
    for (int u = 0; u < light.width_px; ++u) {
      const Eigen::Vector3f at(scale * (float(u) + shift) + 0.35F * time,
                               scale * float(v) - 0.2F * time, 0.5F * time);
      const float puff = std::clamp(0.5F + 1.1F * fractalNoise(at, 4, kSmokeSeed), 0.05F, 1.3F);
      const float through = std::exp(-float(smoke) * kThickness * puff);
      light.at(u, v) = through * light.at(u, v) + (1 - through) * kGrey;
    }
  });
}

}  // namespace softscope
