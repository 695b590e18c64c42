#include "features/subpixel_match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "features/subpixel_formulas.h"

namespace softscope {
namespace {

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
        to[u] = binomial(at[0], at[1], at[2]);
      }
    }
  });
  return out;
}

using WindowPlane = std::array<float, kLargestWindow * kWindowLanes>;

/// Everything about one window of the model image.
struct Patch {
  WindowPlane steepest_u, steepest_v, contrast, weight;
  WindowMatrix information;  // per unit of weight
  float contrast_sq = 0;
  float weight_sq = 0;
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
        live_ignore_(live.ignore),
        window_(windowWeights(options.kRadiusPx)) {}

  /// False where the match is refused.
  bool refine(PixelMatch* match) const {
    if (anchor_.empty()) return refineBy(model_, match);
    PixelMatch anchored = *match, present = *match;
    const bool held = refineBy(anchor_, &anchored);
    if (anchorDecides(held, anchored.sigma_px, static_cast<float>(options_.kMaxSigmaPx))) {
      *match = anchored;
      return true;
    }
    const bool seen = refineBy(model_, &present);
    present.sigma_px = quadratureSum(present.sigma_px, static_cast<float>(options_.kDriftPx));
    *match = anchorIsBetter(held, anchored.sigma_px, seen, present.sigma_px) ? anchored : present;
    return held || seen;
  }

 private:
  bool refineBy(const Raster<float>& model, PixelMatch* match) const {
    const int r = options_.kRadiusPx;
    const int mu = static_cast<int>(std::lround(match->model_px.x()));
    const int mv = static_cast<int>(std::lround(match->model_px.y()));
    if (!isInsideModel(mu, mv, r, model.width_px, model.height_px)) return false;
    const Eigen::Vector2f rest = match->model_px - Eigen::Vector2f(mu, mv);
    const Eigen::Vector2f start = match->live_px - rest;  // of the window's middle
    if (!start.allFinite() ||
        !isInsideLive(start.x(), start.y(), r, live_.width_px, live_.height_px))
      return false;
    Patch patch;
    if (!weigh(mu, mv, static_cast<int>(std::lround(start.x())),
               static_cast<int>(std::lround(start.y())), &patch) ||
        !prepare(model, mu, mv, &patch))
      return false;
    WindowSearch search{
        start.x(),         start.y(),      start.x(), start.y(), inverseOf(patch.information),
        patch.contrast_sq, patch.weight_sq};
    if (!iterate(patch, &search, match)) return false;
    match->live_px = Eigen::Vector2f(search.u, search.v) + rest;
    return true;
  }

  /// Weights of the window without what either image ignores, sum 1.
  bool weigh(int mu, int mv, int lu, int lv, Patch* patch) const {
    const int r = options_.kRadiusPx;
    patch->rows = 2 * r + 1;
    patch->weight.fill(0);
    float kept = 0;
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) {
        const std::size_t k = static_cast<std::size_t>((y + r) * kWindowLanes + x + r);
        const bool ignored = (!model_ignore_.empty() && model_ignore_.at(mu + x, mv + y) != 0) ||
                             (!live_ignore_.empty() && live_ignore_.contains(lu + x, lv + y) &&
                              live_ignore_.at(lu + x, lv + y) != 0);
        if (ignored) continue;
        patch->weight[k] = window_.values[k];
        kept += window_.values[k];
      }
    if (!(kept >= kLeastWindowShare * window_.all)) return false;
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
    WindowMoments moments{};
    for (int y = 0; y < patch->rows; ++y) {
      const float* row = model.row(mv - r + y) + mu - r;
      const float *above = row - model.width_px, *below = row + model.width_px;
      for (int x = 0; x < patch->rows; ++x) {
        const std::size_t k = static_cast<std::size_t>(y * kWindowLanes + x);
        patch->contrast[k] = row[x];
        patch->steepest_u[k] = 0.5f * (row[x + 1] - row[x - 1]);
        patch->steepest_v[k] = 0.5f * (below[x] - above[x]);
        moments.mean += patch->weight[k] * patch->contrast[k];
        moments.gradient_u += patch->weight[k] * patch->steepest_u[k];
        moments.gradient_v += patch->weight[k] * patch->steepest_v[k];
      }
    }
    return project(moments, patch);
  }

  static bool project(WindowMoments m, Patch* patch) {
    for (std::size_t k = 0; k < patch->contrast.size(); ++k) {
      const float t = patch->contrast[k] - m.mean, w = patch->weight[k];
      m.square += w * t * t;
      m.along_u += w * t * (patch->steepest_u[k] - m.gradient_u);
      m.along_v += w * t * (patch->steepest_v[k] - m.gradient_v);
    }
    if (!(m.square > kLeastContrastSq)) return false;
    patch->contrast_sq = m.square;
    WindowMatrix& information = patch->information = {0, 0, 0, 0};
    for (std::size_t k = 0; k < patch->contrast.size(); ++k) {
      const float t = patch->contrast[k] - m.mean, w = patch->weight[k];
      const float u = projectedGradient(patch->steepest_u[k], m.gradient_u, t, m.along_u, m.square),
                  v = projectedGradient(patch->steepest_v[k], m.gradient_v, t, m.along_v, m.square);
      information.uu += w * u * u;
      information.uv += w * u * v;
      information.vu += w * v * u;
      information.vv += w * v * v;
      patch->steepest_u[k] = w * u;
      patch->steepest_v[k] = w * v;
      patch->contrast[k] = w * t;
    }
    return determinantOf(information) > kLeastDeterminant;
  }

  bool iterate(const Patch& patch, WindowSearch* search, PixelMatch* match) const {
    for (int i = 0; i < options_.kIterations; ++i) {
      const SearchStep step =
          takeStep(sample(patch, *search), static_cast<float>(options_.kMaxShiftPx),
                   options_.kRadiusPx, live_.width_px, live_.height_px, search);
      if (step == SearchStep::kRefused) return false;
      if (step == SearchStep::kConverged) break;
    }
    const WindowVerdict verdict =
        judgeWindow(sample(patch, *search), *search, static_cast<float>(options_.kFloorSigmaPx),
                    static_cast<float>(options_.kMinSimilarity));
    match->similarity = verdict.similarity;
    match->sigma_px = verdict.sigma_px;
    return verdict.accepted;
  }

  WindowSums sample(const Patch& patch, const WindowSearch& search) const {
    const float u = search.u - static_cast<float>(options_.kRadiusPx);
    const float v = search.v - static_cast<float>(options_.kRadiusPx);
    const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
    return featureKernels().windowSums(patch.view(), live_.row(v0) + u0, live_.width_px,
                                       u - static_cast<float>(u0), v - static_cast<float>(v0));
  }

  const SubpixelOptions& options_;
  Raster<float> model_, anchor_, live_;
  const Mask& model_ignore_;
  const Mask& live_ignore_;
  WindowWeights window_;
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
