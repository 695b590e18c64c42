// tests/io/textures.h: small pictures with structure at every scale.
#pragma once

#include <opencv2/imgproc.hpp>

#include "core/image.h"

namespace softscope::test {

/// Blurred noise of several scales. `shift_px` moves the scene to the left, so that a right view
/// has a positive one.
inline ColourImage makeTexture(int width, int height, int shift_px = 0, int seed = 1) {
  constexpr int kMargin = 64;
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat sum(height, width + 2 * kMargin, CV_32FC3, cv::Scalar::all(128));
  for (const double sigma : {1.0, 3.0, 8.0}) {
    cv::Mat noise(sum.size(), CV_32FC3);
    random.fill(noise, cv::RNG::UNIFORM, -1.0, 1.0);
    cv::GaussianBlur(noise, noise, {}, sigma);
    sum += noise * (60 * sigma);
  }
  cv::Mat bytes;
  sum.convertTo(bytes, CV_8UC3);
  ColourImage out(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const auto& c = bytes.at<cv::Vec3b>(v, u + kMargin + shift_px);
      out.at(u, v) = {c[0], c[1], c[2]};
    }
  return out;
}

inline double meanDifference(const ColourImage& a, const ColourImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(a.values[i].red - b.values[i].red) +
           std::abs(a.values[i].green - b.values[i].green) +
           std::abs(a.values[i].blue - b.values[i].blue);
  return sum / (3.0 * static_cast<double>(a.size()));
}

}  // namespace softscope::test
