// src/stereo/networks/disparity_network.h: a stereo network of the user, run by OpenCV.
#pragma once

#include <memory>
#include <string>

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// Range of the network input for the levels 0 to 255 of red, green and blue.
enum class NetworkInput {
  kLevels,    // 0 to 255
  kUnit,      // 0 to 1
  kImageNet,  // 0 to 1, minus ImageNet's mean, over its standard deviation
};

/// A network of two images and one disparity: docs/stereo.md, 8.
class DisparityNetwork {
 public:
  /// Reads the file and checks its declarations. Throws InputError.
  DisparityNetwork(const std::string& file, NetworkInput input);
  ~DisparityNetwork();
  DisparityNetwork(const DisparityNetwork&) = delete;
  DisparityNetwork& operator=(const DisparityNetwork&) = delete;

  /// Tests it in a child process on a pair of this size with a known shift,
  /// and loads it. Throws InputError if it cannot be run, or gives less than
  /// half of the pixels a disparity above 0, at most `disparity_max_px`.
  void prepare(int width_px, int height_px, int disparity_max_px);

  /// Disparity of each pixel of `left`; NaN where the output of
  /// the network is not finite. The size must be a prepared one.
  Raster<float> disparity(const ColourImage& left, const ColourImage& right);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope
