#include "stereo/plane.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace softscope {
namespace {

/// Mean over (2 r + 1)² pixels inside the picture, by running sums.
Raster<float> boxMean(const Raster<float>& in, int radius) {
  const int width = in.width_px, height = in.height_px;
  Raster<float> rows(width, height), out(width, height);
  parallelRows(height, [&](int v) {
    const float* a = in.row(v);
    double sum = 0;
    for (int u = 0; u < std::min(radius, width); ++u) sum += a[u];
    for (int u = 0; u < width; ++u) {
      if (u + radius < width) sum += a[u + radius];
      if (u - radius - 1 >= 0) sum -= a[u - radius - 1];
      const int count = std::min(u + radius, width - 1) - std::max(u - radius, 0) + 1;
      rows.at(u, v) = static_cast<float>(sum / count);
    }
  });
  parallelRanges(width, 32, [&](int begin, int end) {
    std::vector<double> sum(static_cast<std::size_t>(end - begin), 0.0);
    const auto add = [&](int v, double sign) {
      for (int u = begin; u < end; ++u)
        sum[static_cast<std::size_t>(u - begin)] += sign * rows.at(u, v);
    };
    for (int v = 0; v < std::min(radius, height); ++v) add(v, 1);
    for (int v = 0; v < height; ++v) {
      if (v + radius < height) add(v + radius, 1);
      if (v - radius - 1 >= 0) add(v - radius - 1, -1);
      const int count = std::min(v + radius, height - 1) - std::max(v - radius, 0) + 1;
      for (int u = begin; u < end; ++u)
        out.at(u, v) = static_cast<float>(sum[static_cast<std::size_t>(u - begin)] / count);
    }
  });
  return out;
}

}  // namespace

Plane bandPass(const GrayImage& image, double highpass_sigma_px) {
  const int width = image.width_px, height = image.height_px;
  Raster<float> brightness(width, height);
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) brightness.at(u, v) = image.at(u, v);
  });
  // Two box means are close to a Gaussian: variance 2 (w² - 1) / 12 with w = 2 r + 1.
  const int radius = std::max(
      1, static_cast<int>(
             std::lround((std::sqrt(6 * highpass_sigma_px * highpass_sigma_px + 1) - 1) / 2)));
  const Raster<float> slow = boxMean(boxMean(brightness, radius), radius);
  Plane out(width, height);
  parallelRows(height, [&](int v) {
    const float* above = brightness.row(std::max(v - 1, 0));
    const float* here = brightness.row(v);
    const float* below = brightness.row(std::min(v + 1, height - 1));
    float* to = out.row(v);
    for (int u = 0; u < width; ++u) {
      const int l = std::max(u - 1, 0), r = std::min(u + 1, width - 1);
      const float smooth = 0.0625f * (above[l] + above[r] + below[l] + below[r]) +
                           0.125f * (above[u] + below[u] + here[l] + here[r]) + 0.25f * here[u];
      to[u] = smooth - slow.at(u, v);
    }
    to[-1] = to[-2] = to[0];
    to[width] = to[width + 1] = to[width + 2] = to[width - 1];
  });
  return out;
}

}  // namespace softscope
