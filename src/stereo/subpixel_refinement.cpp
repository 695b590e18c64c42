#include "stereo/subpixel_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "stereo/depth_steps.h"
#include "stereo/kernels.h"
#include "stereo/plane.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kWindowSigma = 0.55;    // of the radius
constexpr double kFarthestStepPx = 1.5;  // a fit that wanders farther has lost its pixel
constexpr float kStepPx = 1.0f;          // neighbours of one surface differ by at most this …
constexpr float kSlope = 0.4f;           // … and this much more for every pixel between them
constexpr int kMoments = 11;             // see StereoKernels::selectedMoments

std::vector<float> gaussian(double sigma, int radius) {
  std::vector<float> weights;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
  for (int x = -radius; x <= radius; ++x)
    weights.push_back(static_cast<float>(std::exp(-0.5 * x * x / (sigma * sigma)) / sum));
  return weights;
}

/// One Gauss-Newton step after the other; every buffer is allocated once.
class PlaneFit {
 public:
  PlaneFit(const GrayImage& left, const GrayImage& right, const Raster<float>& initial_px,
           const RefinementOptions& options)
      : width_(left.width_px),
        height_(left.height_px),
        radius_(options.radius_px),
        options_(options),
        left_(bandPass(left, options.highpass_sigma_px)),
        right_(bandPass(right, options.highpass_sigma_px)),
        near_step_(nearDepthSteps(initial_px, options.radius_px, kStepPx, kSlope)),
        window_(gaussian(kWindowSigma * options.radius_px, options.radius_px)),
        pixels_(planes<kPixelPlanes>()),
        rows_(planes<kRowPlanes>()) {
    makeSelection();
  }

  /// One step of every pixel; NaN stays NaN.
  DisparityMap step(const Raster<float>& disparity) {
    parallelRanges(height_, 16, [&](int begin, int end) {
      for (int v = begin; v < end; ++v) linearise(disparity, v);
    });
    DisparityMap out{Raster<float>(width_, height_, kNaN), Raster<float>(width_, height_, kNaN)};
    parallelRanges(height_, 16, [&](int begin, int end) {
      Plane moments(width_, kMoments);
      for (int v = begin; v < end; ++v) solveRow(disparity, v, moments, out);
    });
    return out;
  }

 private:
  // What is known of each pixel, and the sums along its row.
  enum { kDisparity, kInformation, kTarget, kResidualSq, kWeight, kPixelPlanes };
  enum { kG0, kG1, kG2, kQ0, kQ1, kE0, kE1, kRowPlanes };

  template <int count>
  std::vector<Plane> planes() const {
    return std::vector<Plane>(count, Plane(width_, height_));
  }

  void makeSelection() {
    for (int y = -radius_; y <= radius_; ++y)
      for (int i = 0; i < kSelectLanes; ++i) {
        const int x = i - radius_;
        const bool inside = x <= radius_;
        selection_window_.push_back(inside ? window_[y + radius_] * window_[i] : 0.0f);
        selection_tolerance_.push_back(kStepPx +
                                       kSlope * std::sqrt(static_cast<float>(x * x + y * y)));
      }
  }

  double priorWeight() const {
    const double ratio = options_.noise_gray / options_.prior_sigma_px;
    return ratio * ratio;
  }

  /// Residual and gradient of every pixel of a row at its present disparity, and their row sums.
  void linearise(const Raster<float>& disparity, int v) {
    const StereoKernels& kernels = stereoKernels();
    Plane valid(width_, 1);
    float* d = pixels_[kDisparity].row(v);
    for (int u = 0; u < width_; ++u) {
      const float value = disparity.at(u, v);
      valid.row(0)[u] = std::isnan(value) ? 0.0f : 1.0f;
      d[u] = std::isnan(value) ? 0.0f : value;
    }
    const auto row = [&](int plane) { return pixels_[plane].row(v); };
    const float noise = static_cast<float>(options_.noise_gray);
    kernels.residualRow({left_.row(v), right_.row(v), d, valid.row(0), width_, 1 / (noise * noise),
                         static_cast<float>(priorWeight()), row(kInformation), row(kTarget),
                         row(kResidualSq), row(kWeight)});
    const auto sums = [&](int in, int out_0, float* out_1, float* out_2) {
      kernels.horizontalMoments(row(in), window_.data(), radius_, width_, rows_[out_0].row(v),
                                out_1, out_2);
    };
    sums(kInformation, kG0, rows_[kG1].row(v), rows_[kG2].row(v));
    sums(kTarget, kQ0, rows_[kQ1].row(v), nullptr);
    sums(kResidualSq, kE0, nullptr, nullptr);
    sums(kWeight, kE1, nullptr, nullptr);
  }

  /// Moments of whole windows for a row, then the plane of each pixel.
  void solveRow(const Raster<float>& disparity, int v, Plane& moments, DisparityMap& out) const {
    windowMoments(v, moments);
    for (int u = 0; u < width_; ++u) {
      const float before = disparity.at(u, v);
      if (std::isnan(before)) continue;
      std::array<float, kMoments> m;
      if (near_step_.at(u, v) != 0)
        selectMoments(u, v, m.data());
      else
        for (int k = 0; k < kMoments; ++k) m[k] = moments.row(k)[u];
      solvePixel(m, before, out.disparity_px.at(u, v), out.sigma_px.at(u, v));
    }
  }

  void windowMoments(int v, Plane& moments) const {
    const StereoKernels& kernels = stereoKernels();
    std::array<std::vector<const float*>, kRowPlanes> around;
    for (int plane = 0; plane < kRowPlanes; ++plane)
      for (int y = -radius_; y <= radius_; ++y) around[plane].push_back(rows_[plane].row(v + y));
    const auto row = [&](int k) { return moments.row(k); };
    kernels.verticalMoments(
        around[kG0].data(), around[kG1].data(), around[kG2].data(), around[kQ0].data(),
        around[kQ1].data(), window_.data(), radius_, width_,
        {row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7), row(8)});
    for (int k = 0; k < 2; ++k)
      kernels.sumRows(around[kE0 + k].data(), window_.data(), 2 * radius_ + 1, width_, row(9 + k));
  }

  void selectMoments(int u, int v, float* moments) const {
    const auto at = [&](int plane) { return pixels_[plane].row(v) + u; };
    stereoKernels().selectedMoments(
        {at(kInformation), at(kTarget), at(kResidualSq), at(kWeight), at(kDisparity),
         pixels_[0].stride(), selection_window_.data(), selection_tolerance_.data(), radius_},
        moments);
  }

  /// D of the 3 x 3 system by Cramer's rule, and its standard error; stays NaN where it fails.
  void solvePixel(const std::array<float, kMoments>& m, float before, float& disparity,
                  float& sigma) const {
    const double a = m[0], b = m[1], c = m[2], d = m[3], e = m[4], f = m[5];
    const double c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
    const double determinant = a * c00 + b * c01 + c * c02;
    if (!(determinant > 1e-3 * a * d * f)) return;  // too few pixels for a plane
    const double found = (c00 * m[6] + c01 * m[7] + c02 * m[8]) / determinant;
    if (!(std::abs(found - before) < kFarthestStepPx)) return;
    // The matched disparity steadies the fit but is no evidence: it doesn't lower the error.
    const double evidence = std::max(1 - priorWeight() * m[10] / a, 1e-3);
    const double noise_sq = m[9] / m[10] + options_.noise_floor_gray * options_.noise_floor_gray;
    const double independent = 2 * M_PI * std::pow(kWindowSigma * radius_, 2);
    const double variance = noise_sq * (c00 / determinant) / (evidence * evidence * independent) +
                            options_.model_sigma_px * options_.model_sigma_px;
    if (!(variance <= options_.max_sigma_px * options_.max_sigma_px)) return;
    disparity = static_cast<float>(found);
    sigma = static_cast<float>(std::sqrt(variance));
  }

  int width_, height_, radius_;
  RefinementOptions options_;
  Plane left_, right_;
  Raster<std::uint8_t> near_step_;
  std::vector<float> window_, selection_window_, selection_tolerance_;
  std::vector<Plane> pixels_, rows_;
};

}  // namespace

DisparityMap refineDisparity(const GrayImage& left, const GrayImage& right,
                             const Raster<float>& initial_px, const RefinementOptions& options) {
  PlaneFit fit(left, right, initial_px, options);
  DisparityMap map{initial_px, Raster<float>(left.width_px, left.height_px, kNaN)};
  for (int i = 0; i < options.iterations; ++i) map = fit.step(map.disparity_px);
  return map;
}

}  // namespace softscope
