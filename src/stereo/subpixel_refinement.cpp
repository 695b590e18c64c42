#include "stereo/subpixel_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/kernels.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kMargin = 16;  // zeros around every plane: windows need no border cases

/// A picture of floats with a margin.
class Plane {
 public:
  Plane(int width, int height, float fill = 0)
      : stride_((width + 2 * kMargin + 15) / 16 * 16),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2 * kMargin),
                fill) {}
  float* row(int v) { return values_.data() + offset(v); }
  const float* row(int v) const { return values_.data() + offset(v); }

 private:
  std::size_t offset(int v) const {
    return static_cast<std::size_t>(v + kMargin) * static_cast<std::size_t>(stride_) + kMargin;
  }
  int stride_;
  std::vector<float> values_;
};

std::vector<float> gaussian(double sigma, int radius) {
  std::vector<float> weights;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
  for (int x = -radius; x <= radius; ++x)
    weights.push_back(static_cast<float>(std::exp(-0.5 * x * x / (sigma * sigma)) / sum));
  return weights;
}

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

/// Brightness without its slow part (light, exposure) and with a little less noise.
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

/// Everything one iteration needs, allocated once.
class PlaneFit {
 public:
  PlaneFit(const GrayImage& left, const GrayImage& right, const RefinementOptions& options)
      : width_(left.width_px),
        height_(left.height_px),
        options_(options),
        left_(bandPass(left, options.highpass_sigma_px)),
        right_(bandPass(right, options.highpass_sigma_px)),
        window_(gaussian(0.55 * options.radius_px, options.radius_px)),
        g_{{width_, height_}, {width_, height_}, {width_, height_}},
        q_{{width_, height_}, {width_, height_}},
        e_{{width_, height_}, {width_, height_}} {}

  /// One Gauss-Newton step of every pixel; NaN stays NaN.
  DisparityMap step(const Raster<float>& disparity) {
    parallelRanges(height_, 16, [&](int begin, int end) { horizontal(disparity, begin, end); });
    DisparityMap out{Raster<float>(width_, height_, kNaN), Raster<float>(width_, height_, kNaN)};
    parallelRanges(height_, 16, [&](int begin, int end) { vertical(disparity, begin, end, out); });
    return out;
  }

 private:
  void horizontal(const Raster<float>& disparity, int begin, int end) {
    const StereoKernels& kernels = stereoKernels();
    Plane rows(width_, 6);
    const float noise = static_cast<float>(options_.noise_gray);
    const float prior = static_cast<float>(options_.prior_sigma_px);
    for (int v = begin; v < end; ++v) {
      float *d = rows.row(0), *valid = rows.row(1);
      for (int u = 0; u < width_; ++u) {
        const float value = disparity.at(u, v);
        valid[u] = std::isnan(value) ? 0.0f : 1.0f;
        d[u] = std::isnan(value) ? 0.0f : value;
      }
      kernels.residualRow({left_.row(v), right_.row(v), d, valid, width_, 1 / (noise * noise),
                           noise * noise / (prior * prior), rows.row(2), rows.row(3), rows.row(4),
                           rows.row(5)});
      const int r = options_.radius_px;
      kernels.horizontalMoments(rows.row(2), window_.data(), r, width_, g_[0].row(v), g_[1].row(v),
                                g_[2].row(v));
      kernels.horizontalMoments(rows.row(3), window_.data(), r, width_, q_[0].row(v), q_[1].row(v),
                                nullptr);
      for (int k = 0; k < 2; ++k) horizontalSum(rows.row(4 + k), e_[k].row(v));
    }
  }

  void horizontalSum(const float* in, float* out) const {
    std::vector<const float*> shifted;
    for (int x = -options_.radius_px; x <= options_.radius_px; ++x) shifted.push_back(in + x);
    stereoKernels().sumRows(shifted.data(), window_.data(), static_cast<int>(shifted.size()),
                            width_, out);
  }

  void vertical(const Raster<float>& disparity, int begin, int end, DisparityMap& out) const {
    const StereoKernels& kernels = stereoKernels();
    Plane rows(width_, 11);
    const PlaneMoments moments{rows.row(0), rows.row(1), rows.row(2), rows.row(3), rows.row(4),
                               rows.row(5), rows.row(6), rows.row(7), rows.row(8)};
    const int r = options_.radius_px, taps = 2 * r + 1;
    for (int v = begin; v < end; ++v) {
      const auto around = [&](const Plane& plane) {
        std::vector<const float*> pointers;
        for (int y = -r; y <= r; ++y) pointers.push_back(plane.row(v + y));
        return pointers;
      };
      kernels.verticalMoments(around(g_[0]).data(), around(g_[1]).data(), around(g_[2]).data(),
                              around(q_[0]).data(), around(q_[1]).data(), window_.data(), r, width_,
                              moments);
      for (int k = 0; k < 2; ++k)
        kernels.sumRows(around(e_[k]).data(), window_.data(), taps, width_, rows.row(9 + k));
      solveRow(disparity.row(v), moments, rows.row(9), rows.row(10), out.disparity_px.row(v),
               out.sigma_px.row(v));
    }
  }

  /// D of the 3 x 3 system by Cramer's rule, and its standard error.
  void solveRow(const float* before, const PlaneMoments& m, const float* residual_sq,
                const float* weight, float* disparity, float* sigma) const {
    for (int u = 0; u < width_; ++u) {
      if (std::isnan(before[u])) continue;
      const double a = m.a00[u], b = m.a10[u], c = m.a01[u], d = m.a20[u], e = m.a11[u],
                   f = m.a02[u];
      const double c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
      const double determinant = a * c00 + b * c01 + c * c02;
      if (!(determinant > 1e-6 * a * d * f)) continue;  // too few pixels for a plane
      const double inverse = 1 / determinant;
      const double found = (c00 * m.b0[u] + c01 * m.b1[u] + c02 * m.b2[u]) * inverse;
      if (!(std::abs(found - before[u]) < kFarthestStepPx)) continue;
      const double variance = (residual_sq[u] + 1e-3) / (weight[u] + 1e-6) * c00 * inverse;
      disparity[u] = static_cast<float>(found);
      sigma[u] = static_cast<float>(std::sqrt(variance));
    }
  }

  static constexpr double kFarthestStepPx = 1.5;
  int width_, height_;
  const RefinementOptions& options_;
  Plane left_, right_;
  std::vector<float> window_;
  Plane g_[3], q_[2], e_[2];
};

}  // namespace

DisparityMap refineDisparity(const GrayImage& left, const GrayImage& right,
                             const Raster<float>& initial_px, const RefinementOptions& options) {
  PlaneFit fit(left, right, options);
  DisparityMap map{initial_px, Raster<float>(left.width_px, left.height_px, kNaN)};
  for (int i = 0; i < options.iterations; ++i) map = fit.step(map.disparity_px);
  for (std::size_t i = 0; i < map.disparity_px.size(); ++i)
    if (!(map.sigma_px.values[i] <= options.max_sigma_px))
      map.disparity_px.values[i] = map.sigma_px.values[i] = kNaN;
  return map;
}

}  // namespace softscope
