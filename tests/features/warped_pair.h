// tests/features/warped_pair.h: a textured picture, and the same bent by a shift known exactly.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "features/matcher.h"
#include "support/scene.h"

namespace softscope::test {

struct WarpedPair {
  MatchPicture model, live;
  /// Where the model's pixel went.
  static Eigen::Vector2d truth(const Eigen::Vector2d& at) {
    return at + Eigen::Vector2d(4.3 + 1.5 * std::sin(at.x() / 40 + at.y() / 55),
                                -2.6 + 1.2 * std::cos(at.x() / 50 - at.y() / 45));
  }
};

inline double textureAt(const Eigen::Vector2d& at) {
  const Eigen::Vector3d place(at.x(), at.y(), 17.3);
  return 60 + 130 * (0.5 * solidTexture(place, 6.1) + 0.3 * solidTexture(place, 13.7) +
                     0.2 * solidTexture(place, 37.0));
}

/// Live pictures are 15 % brighter plus 8 grey levels, both have `noise_gray` of their own.
inline WarpedPair makeWarpedPair(double noise_gray, int width = 320, int height = 240) {
  WarpedPair pair;
  pair.model.gray = pair.live.gray = GrayImage(width, height);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1);
  const auto byte = [&](double gray) {
    return static_cast<std::uint8_t>(
        std::lround(std::clamp(gray + noise_gray * noise(random), 0.0, 255.0)));
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector2d live(u, v);
      Eigen::Vector2d source = live;
      for (int k = 0; k < 12; ++k) source += live - WarpedPair::truth(source);
      pair.model.gray.at(u, v) = byte(textureAt(live));
      pair.live.gray.at(u, v) = byte(1.15 * textureAt(source) + 8);
    }
  return pair;
}

struct MatchErrors {
  std::size_t count = 0;
  double median_px = 0, outlier_share = 0;  // farther than 1 px
  double median_in_sigmas = 0;
};

inline double medianOf(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline MatchErrors errorsOf(const std::vector<PixelMatch>& matches) {
  std::vector<double> errors, in_sigmas;
  double outliers = 0;
  for (const PixelMatch& match : matches) {
    const double error =
        (match.live_px.cast<double>() - WarpedPair::truth(match.model_px.cast<double>())).norm();
    errors.push_back(error);
    in_sigmas.push_back(error / match.sigma_px);
    outliers += error > 1 ? 1 : 0;
  }
  return {matches.size(), medianOf(errors), matches.empty() ? 0 : outliers / matches.size(),
          medianOf(in_sigmas)};
}

}  // namespace softscope::test
