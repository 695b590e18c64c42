// src/stereo/refinement/refinement_window.h: weights and limits of sub-pixel refinement, computed
// once on the host.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "stereo/kernels/refinement_kernels.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Of one refinement: `radius` to each side of a pixel.
struct RefinementWindow {
  static constexpr float kFarthestStepPx = 1.5f;  // a fit that moves farther has lost its pixel
  static constexpr float kStepPx = 1.0f;  // maximum difference of neighbours of one surface …
  static constexpr float kSlope = 0.4f;   // … and this much more per pixel between them
  static constexpr float kClearStepPx = 2.0f;  // a step larger than noise of the matching

  // Of the pixels by which relief is judged: a window twice as wide.
  static constexpr int kReliefSpacingPx = 2;

  std::vector<float> weights;               // 2 radius + 1: a Gaussian
  std::vector<float> selection, tolerance;  // (2 radius + 1) x kSelectLanes: see SelectedRows
};

inline std::vector<float> gaussianWeights(double sigma, int radius) {
  std::vector<float> weights;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
  for (int x = -radius; x <= radius; ++x)
    weights.push_back(static_cast<float>(std::exp(-0.5 * x * x / (sigma * sigma)) / sum));
  return weights;
}

inline RefinementWindow refinementWindow(const RefinementOptions& options) {
  const int radius = options.radius_px;
  RefinementWindow window;
  window.weights = gaussianWeights(options.windowSigmaPx(), radius);
  for (int y = -radius; y <= radius; ++y)
    for (int i = 0; i < kSelectLanes; ++i) {
      const int x = i - radius;
      const float apart = std::sqrt(static_cast<float>(x * x + y * y));
      const auto row = static_cast<std::size_t>(y + radius);
      const bool inside = x <= radius;
      window.selection.push_back(
          inside ? window.weights[row] * window.weights[static_cast<std::size_t>(i)] : 0.0f);
      window.tolerance.push_back(inside
                                     ? RefinementWindow::kStepPx + RefinementWindow::kSlope * apart
                                     : std::numeric_limits<float>::infinity());
    }
  return window;
}

/// Distance of a pixel on a straight rim from the centre of its evidence, where texture is even.
inline float rimFromEvidencePx(const RefinementOptions& options) {
  const std::vector<float> weights = gaussianWeights(options.windowSigmaPx(), options.radius_px);
  float sum = 0, moment = 0;
  for (int x = 0; x <= options.radius_px; ++x) {
    const float weight = weights[static_cast<std::size_t>(options.radius_px + x)];
    sum += weight;
    moment += weight * static_cast<float>(x);
  }
  return moment / sum;
}

/// One step of the refinement.
struct RefinementStep {
  float relaxation;    // share of the step that is applied; above 1 converges faster
  float of_disparity;  // 1: its planes fit the disparity, 0: the remaining difference
  bool last;
};
inline RefinementStep refinementStep(int i) {
  using Options = RefinementOptions;
  return {i < Options::plane_steps ? static_cast<float>(Options::relaxation[i]) : 1.0f,
          i < Options::plane_steps ? 1.0f : 0.0f, i + 1 == Options::steps};
}

/// Weight of the matched disparity against the brightness.
inline float disparityPriorWeight(const RefinementOptions& options) {
  return static_cast<float>(std::pow(options.noise_gray / options.prior_sigma_px, 2));
}
inline ResidualLimits residualLimits(const RefinementOptions& options, const RefinementStep& step) {
  const float noise = static_cast<float>(options.noise_gray),
              light = static_cast<float>(options.lightGray());
  const float prior_weight = disparityPriorWeight(options);
  return {1 / (noise * noise), prior_weight, light * light,
          static_cast<float>(1 - options.slow_evidence) / prior_weight, step.of_disparity};
}

/// Limits of estimatePlaneErrors(), squared as in PlaneRow.
struct PlaneLimits {
  float farthest_step_px, prior_weight, noise_floor_sq, independent_pixels, model_variance_px2,
      max_variance_px2, max_difference;
};
inline PlaneLimits planeLimits(const RefinementOptions& options) {
  const auto squared = [](double x) { return static_cast<float>(x * x); };
  return {RefinementWindow::kFarthestStepPx,         disparityPriorWeight(options),
          squared(options.noise_floor_gray),         static_cast<float>(options.independentPx2()),
          squared(options.model_sigma_px),           squared(options.max_sigma_px),
          static_cast<float>(options.max_difference)};
}

/// Weights of the low-pass brightness. Two box means in sequence are close to a Gaussian:
/// variance 2 (w² - 1) / 12 with a width of w = 2 r + 1. Returns their 4 r + 1 weights.
inline std::vector<float> slowBrightnessWeights(double sigma_px) {
  const int radius =
      std::max(1, static_cast<int>(std::lround((std::sqrt(6 * sigma_px * sigma_px + 1) - 1) / 2)));
  const int width = 2 * radius + 1;
  std::vector<float> weights;
  for (int x = -2 * radius; x <= 2 * radius; ++x)
    weights.push_back(static_cast<float>(width - std::abs(x)) / static_cast<float>(width * width));
  return weights;
}
/// Weights of the 3 x 3 filter against noise.
constexpr float kBinomialWeights[3] = {0.25f, 0.5f, 0.25f};

}  // namespace softscope
