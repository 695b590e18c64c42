// eval/simulation/camera/sensor.h: camera model: from light to an 8-bit image.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/image.h"

namespace softscope {

struct SensorOptions {
  double exposure = 1.2;
  double exposure_change = 0;  // 0.2: 20 % up and down
  double exposure_period_s = 2;
  double vignetting = 0.45;   // loss of light in the corners, 0 to 1
  double blur_px = 0.45;      // standard deviation of the lens; 0: none
  double shutter = 0;         // share of a frame's time that it is open; 0: too short to blur
  double noise = 0.006;       // standard deviation at black, white = 1
  double shot_noise = 0.012;  // and at white, from the light itself

  /// Throws OptionError.
  void validate() const;
  double exposureAt(double time_s) const;
};

/// `seed` decides the noise; no two images should share it.
ColourImage takePicture(const Raster<Eigen::Vector3f>& light, const SensorOptions& options,
                        double time_s, std::uint64_t seed);

}  // namespace softscope
