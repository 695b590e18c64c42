// eval/simulation/camera/sensor.cpp: blur, vignetting, exposure, noise, shoulder, sRGB.
#include "eval/simulation/camera/sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "eval/simulation/camera/camera_settings.h"
#include "eval/simulation/noise/random.h"

namespace softscope {
namespace {

using Light = Raster<Eigen::Vector3f>;

std::vector<float> gaussianKernel(double sigma_px) {
  const int radius = static_cast<int>(std::ceil(3 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += weights.back();
  }
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

/// Along one axis; border pixels are replicated.
Light blurred(const Light& light, const std::vector<float>& kernel, bool along_rows) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Light result(light.width_px, light.height_px, Eigen::Vector3f::Zero());
  parallelRows(light.height_px, [&](int v) {
    for (int u = 0; u < light.width_px; ++u)
      for (int i = -radius; i <= radius; ++i) {
        const int x = along_rows ? std::clamp(u + i, 0, light.width_px - 1) : u;
        const int y = along_rows ? v : std::clamp(v + i, 0, light.height_px - 1);
        result.at(u, v) += kernel[i + radius] * light.at(x, y);
      }
  });
  return result;
}

/// Linear light to sRGB (IEC 61966-2-1) in 255ths with fractions, with soft highlights.
class ToneCurve {
 public:
  ToneCurve() {
    for (int i = 0; i <= kSteps; ++i)
      values_[i] = static_cast<float>(255 * curve(kTop * i / kSteps));
  }
  std::uint8_t operator()(float light) const {
    const float at = std::clamp(light, 0.0F, float(kTop)) * (kSteps / float(kTop));
    const int i = std::min(static_cast<int>(at), kSteps - 1);
    const float value = values_[i] + (at - float(i)) * (values_[i + 1] - values_[i]);
    return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
  }

 private:
  static constexpr int kSteps = 16384;
  static constexpr double kTop = 4;
  static constexpr double kShoulder = 0.6;

  static double curve(double x) {
    if (x > kShoulder)
      x = kShoulder + (1 - kShoulder) * (1 - std::exp((kShoulder - x) / (1 - kShoulder)));
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  }
  std::array<float, kSteps + 1> values_{};
};

/// Approximately normal, mean 0, standard deviation 1: sum of four 16-bit numbers.
float noiseOf(std::uint64_t bits) {
  const auto sum = static_cast<float>((bits & 0xffff) + (bits >> 16 & 0xffff) +
                                      (bits >> 32 & 0xffff) + (bits >> 48));
  return (sum - 2 * 65535.0F) / 37837.2F;
}

}  // namespace

void SensorOptions::validate() const { requireAllowed(*this); }

double SensorOptions::exposureAt(double time_s) const {
  return exposure * (1 + exposure_change * std::sin(2 * M_PI * time_s / exposure_period_s));
}

ColourImage takePicture(const Light& light, const SensorOptions& options, double time_s,
                        std::uint64_t seed) {
  static const ToneCurve kTone;
  Light sharp_or_not = light;
  if (options.blur_px > 0) {
    const std::vector<float> kernel = gaussianKernel(options.blur_px);
    sharp_or_not = blurred(blurred(light, kernel, true), kernel, false);
  }
  const auto exposure = static_cast<float>(options.exposureAt(time_s));
  const auto loss = static_cast<float>(options.vignetting),
             read = static_cast<float>(options.noise),
             shot = static_cast<float>(options.shot_noise);
  const float middle_u = 0.5F * float(light.width_px - 1),
              middle_v = 0.5F * float(light.height_px - 1);
  const float corner2 = std::max(1.0F, middle_u * middle_u + middle_v * middle_v);
  ColourImage picture(light.width_px, light.height_px);
  parallelRows(light.height_px, [&](int v) {
    for (int u = 0; u < light.width_px; ++u) {
      const float du = float(u) - middle_u, dv = float(v) - middle_v;
      const float gain = exposure * (1 - loss * (du * du + dv * dv) / corner2);
      std::uint8_t values[3];
      for (int c = 0; c < 3; ++c) {
        const float x = gain * sharp_or_not.at(u, v)[c];
        const float sigma = std::sqrt(read * read + shot * shot * std::min(x, 1.0F));
        const std::uint64_t pixel = (std::uint64_t(v) * light.width_px + u) * 3 + c;
        values[c] = kTone(x + sigma * noiseOf(mixBits(seed + pixel)));
      }
      picture.at(u, v) = {values[0], values[1], values[2]};
    }
  });
  return picture;
}

}  // namespace softscope
