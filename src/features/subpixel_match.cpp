#include "features/subpixel_match.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "features/kernels.h"

namespace softscope {
namespace {

/// Neighbouring pixels' residuals are alike after smoothing, so a window holds less information
/// than its number of pixels; measured against true errors.
constexpr float kCorrelatedPixels = 4.0f;
constexpr float kLeastWindowShare = 0.6f;  // of the window's weight that isn't ignored
constexpr float kLeastContrastSq = 0.5f;   // variance of the window, grey levels²
constexpr float kConvergedPx = 0.003f;
constexpr float kLargestSigmaPx = 1.5f;  // of any match; more is no place

/// A 3 x 3 binomial filter: less noise, and bilinear samples that hardly depend on the fraction.
Raster<float> smoothed(const GrayImage& image) {
  const int width = image.width_px, height = image.height_px;
  Raster<float> out(width, height);
  parallelRanges(height, 16, [&](int begin, int end) {
    std::vector<int> upright(static_cast<std::size_t>(width) + 2);
    for (int v = begin; v < end; ++v) {
      const std::uint8_t* above = image.row(std::max(v - 1, 0));
      const std::uint8_t* here = image.row(v);
      const std::uint8_t* below = image.row(std::min(v + 1, height - 1));
      for (int u = 0; u < width; ++u)
        upright[static_cast<std::size_t>(u) + 1] = above[u] + 2 * here[u] + below[u];
      upright.front() = upright[1];
      upright.back() = upright[static_cast<std::size_t>(width)];
      float* to = out.row(v);
      for (int u = 0; u < width; ++u) {
        const int* at = upright.data() + u;
        to[u] = 0.0625f * static_cast<float>(at[0] + 2 * at[1] + at[2]);
      }
    }
  });
  return out;
}

using WindowPlane = std::array<float, kLargestWindow * kWindowLanes>;

/// Everything about one window of the model picture.
struct Patch {
  WindowPlane steepest_u, steepest_v, contrast, weight;
  Eigen::Matrix2f information;  // per unit of weight
  float contrast_sq = 0;
  float weight_sq = 0;  // sum of squared weights: 1 / independent pixels
  int rows = 0;

  WindowTemplate view() const {
    return {steepest_u.data(), steepest_v.data(), contrast.data(), weight.data(), rows};
  }
};

class Refiner {
 public:
  Refiner(const MatchPicture& model, const MatchPicture& live, const SubpixelOptions& options)
      : options_(options),
        model_(smoothed(model.gray)),
        anchor_(model.anchor.empty() ? Raster<float>() : smoothed(model.anchor)),
        live_(smoothed(live.gray)),
        model_ignore_(model.ignore),
        live_ignore_(live.ignore) {
    fillWindow();
  }

  /// False where the match is refused.
  bool refine(PixelMatch* match) const {
    if (anchor_.empty()) return refineBy(model_, match);
    PixelMatch anchored = *match, present = *match;
    const bool held = refineBy(anchor_, &anchored);
    if (held && anchored.sigma_px <= static_cast<float>(options_.kMaxSigmaPx)) {
      *match = anchored;
      return true;
    }
    const bool seen = refineBy(model_, &present);
    present.sigma_px = std::hypot(present.sigma_px, static_cast<float>(options_.kDriftPx));
    *match = held && (!seen || anchored.sigma_px < present.sigma_px) ? anchored : present;
    return held || seen;
  }

 private:
  bool refineBy(const Raster<float>& model, PixelMatch* match) const {
    const int r = options_.kRadiusPx;
    const int mu = static_cast<int>(std::lround(match->model_px.x()));
    const int mv = static_cast<int>(std::lround(match->model_px.y()));
    if (!insideModel(mu, mv, r)) return false;
    const Eigen::Vector2f rest = match->model_px - Eigen::Vector2f(mu, mv);
    const Eigen::Vector2f start = match->live_px - rest;  // of the window's middle
    if (!start.allFinite() || !insideLive(start, r)) return false;
    Patch patch;
    if (!weigh(mu, mv, static_cast<int>(std::lround(start.x())),
               static_cast<int>(std::lround(start.y())), &patch) ||
        !prepare(model, mu, mv, &patch))
      return false;
    Eigen::Vector2f centre = start;
    if (!iterate(patch, &centre, match)) return false;
    match->live_px = centre + rest;
    return true;
  }

  void fillWindow() {
    const int r = options_.kRadiusPx;
    const float sigma = 0.8f * static_cast<float>(r) + 0.5f;
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x)
        window_[static_cast<std::size_t>((y + r) * kWindowLanes + x + r)] =
            std::exp(-0.5f * static_cast<float>(x * x + y * y) / (sigma * sigma));
  }

  bool insideModel(int u, int v, int r) const {
    return u - r - 1 >= 0 && v - r - 1 >= 0 && u + r + 1 < model_.width_px &&
           v + r + 1 < model_.height_px;
  }
  /// The kernel reads kWindowLanes + 1 columns and one row more than the window.
  bool insideLive(const Eigen::Vector2f& centre, int r) const {
    const float u = centre.x() - static_cast<float>(r), v = centre.y() - static_cast<float>(r);
    return u >= 0 && v >= 0 && u + kWindowLanes + 1 < static_cast<float>(live_.width_px) &&
           v + static_cast<float>(2 * r + 2) < static_cast<float>(live_.height_px);
  }

  /// Weights of the window without what either picture ignores, sum 1.
  bool weigh(int mu, int mv, int lu, int lv, Patch* patch) const {
    const int r = options_.kRadiusPx;
    patch->rows = 2 * r + 1;
    patch->weight.fill(0);
    float all = 0, kept = 0;
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) {
        const std::size_t k = static_cast<std::size_t>((y + r) * kWindowLanes + x + r);
        all += window_[k];
        const bool ignored = (!model_ignore_.empty() && model_ignore_.at(mu + x, mv + y) != 0) ||
                             (!live_ignore_.empty() && live_ignore_.contains(lu + x, lv + y) &&
                              live_ignore_.at(lu + x, lv + y) != 0);
        if (ignored) continue;
        patch->weight[k] = window_[k];
        kept += window_[k];
      }
    if (!(kept >= kLeastWindowShare * all)) return false;
    patch->weight_sq = 0;
    for (float& w : patch->weight) {
      w /= kept;
      patch->weight_sq += w * w;
    }
    return true;
  }

  /// Gradients and contrast of the model's window; projects mean and contrast out of the gradients.
  bool prepare(const Raster<float>& model, int mu, int mv, Patch* patch) const {
    const int r = options_.kRadiusPx;
    patch->steepest_u.fill(0);
    patch->steepest_v.fill(0);
    patch->contrast.fill(0);
    float mean = 0, mean_gu = 0, mean_gv = 0;
    for (int y = 0; y < patch->rows; ++y) {
      const float* row = model.row(mv - r + y) + mu - r;
      const float *above = row - model.width_px, *below = row + model.width_px;
      for (int x = 0; x < patch->rows; ++x) {
        const std::size_t k = static_cast<std::size_t>(y * kWindowLanes + x);
        patch->contrast[k] = row[x];
        patch->steepest_u[k] = 0.5f * (row[x + 1] - row[x - 1]);
        patch->steepest_v[k] = 0.5f * (below[x] - above[x]);
        mean += patch->weight[k] * patch->contrast[k];
        mean_gu += patch->weight[k] * patch->steepest_u[k];
        mean_gv += patch->weight[k] * patch->steepest_v[k];
      }
    }
    return project(mean, mean_gu, mean_gv, patch);
  }

  bool project(float mean, float mean_gu, float mean_gv, Patch* patch) const {
    float square = 0, along_u = 0, along_v = 0;
    for (std::size_t k = 0; k < patch->contrast.size(); ++k) {
      const float t = patch->contrast[k] - mean, w = patch->weight[k];
      square += w * t * t;
      along_u += w * t * (patch->steepest_u[k] - mean_gu);
      along_v += w * t * (patch->steepest_v[k] - mean_gv);
    }
    if (!(square > kLeastContrastSq)) return false;
    patch->contrast_sq = square;
    patch->information.setZero();
    for (std::size_t k = 0; k < patch->contrast.size(); ++k) {
      const float t = patch->contrast[k] - mean, w = patch->weight[k];
      const Eigen::Vector2f g(patch->steepest_u[k] - mean_gu - t * along_u / square,
                              patch->steepest_v[k] - mean_gv - t * along_v / square);
      patch->information += w * g * g.transpose();
      patch->steepest_u[k] = w * g.x();
      patch->steepest_v[k] = w * g.y();
      patch->contrast[k] = w * t;
    }
    return patch->information.determinant() > 1e-6f;
  }

  bool iterate(const Patch& patch, Eigen::Vector2f* centre, PixelMatch* match) const {
    const Eigen::Matrix2f inverse = patch.information.inverse();
    const Eigen::Vector2f start = *centre;
    const float farthest = static_cast<float>(options_.kMaxShiftPx);
    for (int i = 0; i < options_.kIterations; ++i) {
      const WindowSums sums = sample(patch, *centre);
      const float gain = sums.along_contrast / patch.contrast_sq;
      if (!(gain > 0.1f && gain < 10.0f)) return false;
      const Eigen::Vector2f step = inverse * Eigen::Vector2f(sums.along_u, sums.along_v) / gain;
      *centre -= step;
      if (!((*centre - start).norm() <= farthest) || !insideLive(*centre, options_.kRadiusPx))
        return false;
      if (step.norm() < kConvergedPx) break;
    }
    return judge(patch, inverse, sample(patch, *centre), match);
  }

  WindowSums sample(const Patch& patch, const Eigen::Vector2f& centre) const {
    const float u = centre.x() - static_cast<float>(options_.kRadiusPx);
    const float v = centre.y() - static_cast<float>(options_.kRadiusPx);
    const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
    return featureKernels().windowSums(patch.view(), live_.row(v0) + u0, live_.width_px,
                                       u - static_cast<float>(u0), v - static_cast<float>(v0));
  }

  /// Standard error from what the window leaves unexplained.
  bool judge(const Patch& patch, const Eigen::Matrix2f& inverse, const WindowSums& sums,
             PixelMatch* match) const {
    const float variance = sums.square - sums.mean * sums.mean;
    if (!(variance > 0)) return false;
    const float gain = sums.along_contrast / patch.contrast_sq;
    match->similarity = sums.along_contrast / std::sqrt(patch.contrast_sq * variance);
    const float unexplained = variance * std::max(0.0f, 1 - match->similarity * match->similarity);
    const float half_trace = 0.5f * inverse.trace();
    const float worst =
        half_trace + std::sqrt(std::max(0.0f, half_trace * half_trace - inverse.determinant()));
    const float floor = static_cast<float>(options_.kFloorSigmaPx);
    match->sigma_px = std::sqrt(
        kCorrelatedPixels * patch.weight_sq * unexplained * worst / (gain * gain) + floor * floor);
    return match->similarity >= static_cast<float>(options_.kMinSimilarity) &&
           match->sigma_px <= kLargestSigmaPx;
  }

  const SubpixelOptions& options_;
  Raster<float> model_, anchor_, live_;
  const Mask& model_ignore_;
  const Mask& live_ignore_;
  WindowPlane window_{};
};

}  // namespace

std::vector<PixelMatch> refineMatches(const MatchPicture& model, const MatchPicture& live,
                                      const std::vector<PixelMatch>& rough,
                                      const SubpixelOptions& options) {
  if (rough.empty()) return {};
  const Refiner refiner(model, live, options);
  std::vector<PixelMatch> moved = rough;
  std::vector<std::uint8_t> kept(rough.size(), 0);
  parallelRanges(static_cast<int>(rough.size()), 64, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      kept[k] = refiner.refine(&moved[k]) ? 1 : 0;
    }
  });
  std::vector<PixelMatch> refined;
  for (std::size_t k = 0; k < moved.size(); ++k)
    if (kept[k] != 0) refined.push_back(moved[k]);
  return refined;
}

}  // namespace softscope
