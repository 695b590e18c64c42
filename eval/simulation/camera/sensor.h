// eval/simulation/camera/sensor.h: camera sensor: linear light to an 8-bit image.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/image.h"

namespace softscope {

struct SensorOptions {
  double exposure = 1.2;
  double exposure_change = 0;  // 0.2: plus and minus 20 %
  double exposure_period_s = 2;
  double vignetting = 0.45;   // relative loss in the corners, 0 to 1
  double blur_px = 0.45;      // standard deviation of the lens blur; 0: none
  double shutter = 0;         // exposure time as a share of the frame time; 0: no motion blur
  double noise = 0.006;       // standard deviation at black; white = 1
  double shot_noise = 0.012;  // standard deviation at white, from photon noise

  /// Throws OptionError.
  void validate() const;
  double exposureAt(double time_s) const;
};

/// `seed` determines the noise; images should have different seeds.
ColourImage takePicture(const Raster<Eigen::Vector3f>& light, const SensorOptions& options,
                        double time_s, std::uint64_t seed);

}  // namespace softscope
