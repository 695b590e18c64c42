#include "features/subpixel_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

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
  WindowPlane steepest_u, steepest_v, contrast;
  WindowPlane own_weight;     // where pixels are ignored
  const WindowPlane* weight;  // sum 1
  float weight_sq;
  Eigen::Vector2f rest;  // of the match beside the window's middle
  WindowSearch search;

  WindowTemplate view(int rows) const {
    return {steepest_u.data(), steepest_v.data(), contrast.data(), weight->data(), rows};
  }
};

/// Matches whose windows become templates at the same time.
struct Batch {
  int count = 0;
  std::array<Patch, kTemplateLanes> patches;
  std::array<const float*, kTemplateLanes> corners;
  std::array<std::size_t, kTemplateLanes> matches;
};

/// Whether one of the window's pixels is marked; at least 8 columns.
bool holdsMark(const Mask& mask, int u0, int v0, int side) {
  if (mask.empty()) return false;
  std::uint64_t found = 0;
  for (int y = 0; y < side; ++y) {
    const std::uint8_t* row = mask.row(v0 + y) + u0;
    for (const int x : {0, side - 8}) {
      std::uint64_t eight;
      std::memcpy(&eight, row + x, sizeof eight);
      found |= eight;
    }
  }
  return found != 0;
}

class Refiner {
 public:
  Refiner(const MatchPicture& model, const MatchPicture& live, const SubpixelOptions& options)
      : options_(options),
        model_(smoothed(model.gray)),
        anchor_(model.anchor.empty() ? Raster<float>() : smoothed(model.anchor)),
        live_(smoothed(live.gray)),
        model_ignore_(model.ignore),
        live_ignore_(live.ignore),
        window_(windowWeights(options.kRadiusPx)) {
    std::copy(std::begin(window_.values), std::end(window_.values), whole_.begin());
    whole_sq_ = scaleToOne(window_.all, &whole_);
  }

  /// Which are kept.
  std::vector<std::uint8_t> refine(PixelMatch* matches, std::size_t count) const {
    if (anchor_.empty()) return refineBy(model_, matches, count);
    std::vector<PixelMatch> anchored(matches, matches + count);
    std::vector<std::uint8_t> held = refineBy(anchor_, anchored.data(), count);
    std::vector<std::size_t> undecided;
    std::vector<PixelMatch> present;
    for (std::size_t i = 0; i < count; ++i) {
      if (anchorDecides(held[i] != 0, anchored[i].sigma_px,
                        static_cast<float>(options_.kMaxSigmaPx))) {
        matches[i] = anchored[i];
      } else {
        undecided.push_back(i);
        present.push_back(matches[i]);
      }
    }
    const std::vector<std::uint8_t> seen = refineBy(model_, present.data(), present.size());
    for (std::size_t k = 0; k < undecided.size(); ++k) {
      const std::size_t i = undecided[k];
      present[k].sigma_px =
          quadratureSum(present[k].sigma_px, static_cast<float>(options_.kDriftPx));
      matches[i] =
          anchorIsBetter(held[i] != 0, anchored[i].sigma_px, seen[k] != 0, present[k].sigma_px)
              ? anchored[i]
              : present[k];
      held[i] = held[i] != 0 || seen[k] != 0;
    }
    return held;
  }

 private:
  int rows() const { return 2 * options_.kRadiusPx + 1; }

  std::vector<std::uint8_t> refineBy(const Raster<float>& model, PixelMatch* matches,
                                     std::size_t count) const {
    std::vector<std::uint8_t> held(count, 0);
    Batch batch;
    for (std::size_t i = 0; i < count; ++i) {
      if (!place(model, matches[i], &batch)) continue;
      batch.matches[static_cast<std::size_t>(batch.count++)] = i;
      if (batch.count < kTemplateLanes) continue;
      finish(model, &batch, matches, held.data());
    }
    if (batch.count > 0) finish(model, &batch, matches, held.data());
    return held;
  }

  /// Puts a match into the batch. False where its windows leave an image or are mostly ignored.
  bool place(const Raster<float>& model, const PixelMatch& match, Batch* batch) const {
    const int r = options_.kRadiusPx;
    const int mu = static_cast<int>(std::lround(match.model_px.x()));
    const int mv = static_cast<int>(std::lround(match.model_px.y()));
    if (!isInsideModel(mu, mv, r, model.width_px, model.height_px)) return false;
    const Eigen::Vector2f rest = match.model_px - Eigen::Vector2f(mu, mv);
    const Eigen::Vector2f start = match.live_px - rest;  // of the window's middle
    if (!start.allFinite() ||
        !isInsideLive(start.x(), start.y(), r, live_.width_px, live_.height_px))
      return false;
    const std::size_t k = static_cast<std::size_t>(batch->count);
    Patch& patch = batch->patches[k];
    if (!weigh(mu - r, mv - r, static_cast<int>(std::lround(start.x())) - r,
               static_cast<int>(std::lround(start.y())) - r, &patch))
      return false;
    batch->corners[k] = model.row(mv - r) + mu - r;
    patch.rest = rest;
    patch.search.u = patch.search.start_u = start.x();
    patch.search.v = patch.search.start_v = start.y();
    return true;
  }

  /// Weights of the window without what either image ignores, sum 1.
  bool weigh(int model_u, int model_v, int live_u, int live_v, Patch* patch) const {
    const bool model_marked = holdsMark(model_ignore_, model_u, model_v, rows());
    const bool live_marked = holdsMark(live_ignore_, live_u, live_v, rows());
    patch->weight = &whole_;
    patch->weight_sq = whole_sq_;
    if (!model_marked && !live_marked) return true;
    patch->own_weight.fill(0);
    float kept = 0;
    for (int y = 0; y < rows(); ++y)
      for (int x = 0; x < rows(); ++x) {
        if ((model_marked && model_ignore_.at(model_u + x, model_v + y) != 0) ||
            (live_marked && live_ignore_.at(live_u + x, live_v + y) != 0))
          continue;
        const std::size_t k = static_cast<std::size_t>(y * kWindowLanes + x);
        patch->own_weight[k] = window_.values[k];
        kept += window_.values[k];
      }
    if (!(kept >= kLeastWindowShare * window_.all)) return false;
    patch->weight = &patch->own_weight;
    patch->weight_sq = scaleToOne(kept, &patch->own_weight);
    return true;
  }

  /// Returns the sum of the squares.
  static float scaleToOne(float sum, WindowPlane* weights) {
    float square = 0;
    for (float& w : *weights) {
      w /= sum;
      square += w * w;
    }
    return square;
  }

  /// Empties the batch.
  void finish(const Raster<float>& model, Batch* batch, PixelMatch* matches,
              std::uint8_t* held) const {
    TemplateWindows windows{};
    TemplateResults results{};
    windows.stride = model.width_px;
    windows.rows = rows();
    for (std::size_t k = 0; k < kTemplateLanes; ++k) {
      // Lanes to spare repeat the first match.
      const std::size_t from = k < static_cast<std::size_t>(batch->count) ? k : 0;
      Patch& patch = batch->patches[k];
      windows.corner[k] = batch->corners[from];
      windows.weight[k] = batch->patches[from].weight->data();
      results.steepest_u[k] = patch.steepest_u.data();
      results.steepest_v[k] = patch.steepest_v.data();
      results.contrast[k] = patch.contrast.data();
    }
    featureKernels().windows->windowTemplates(windows, &results);
    for (std::size_t k = 0; k < static_cast<std::size_t>(batch->count); ++k) {
      const std::size_t i = batch->matches[k];
      const WindowMatrix information{results.uu[k], results.uv[k], results.vu[k], results.vv[k]};
      held[i] = results.contrast_sq[k] > kLeastContrastSq &&
                determinantOf(information) > kLeastDeterminant &&
                iterate(information, results.contrast_sq[k], &batch->patches[k], &matches[i]);
    }
    batch->count = 0;
  }

  bool iterate(const WindowMatrix& information, float contrast_sq, Patch* patch,
               PixelMatch* match) const {
    WindowSearch& search = patch->search;
    search.inverse = inverseOf(information);
    search.contrast_sq = contrast_sq;
    search.weight_sq = patch->weight_sq;
    for (int i = 0; i < options_.kIterations; ++i) {
      const SearchStep step =
          takeStep(sample(*patch), static_cast<float>(options_.kMaxShiftPx), options_.kRadiusPx,
                   live_.width_px, live_.height_px, &search);
      if (step == SearchStep::kRefused) return false;
      if (step == SearchStep::kConverged) break;
    }
    const WindowVerdict verdict =
        classifyWindow(sample(*patch), search, static_cast<float>(options_.kFloorSigmaPx),
                       static_cast<float>(options_.kMinSimilarity));
    match->similarity = verdict.similarity;
    match->sigma_px = verdict.sigma_px;
    if (!verdict.accepted) return false;
    match->live_px = Eigen::Vector2f(search.u, search.v) + patch->rest;
    return true;
  }

  WindowSums sample(const Patch& patch) const {
    const float u = patch.search.u - static_cast<float>(options_.kRadiusPx);
    const float v = patch.search.v - static_cast<float>(options_.kRadiusPx);
    const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
    return featureKernels().windows->windowSums(patch.view(rows()), live_.row(v0) + u0,
                                                live_.width_px, u - static_cast<float>(u0),
                                                v - static_cast<float>(v0));
  }

  const SubpixelOptions& options_;
  Raster<float> model_, anchor_, live_;
  const Mask& model_ignore_;
  const Mask& live_ignore_;
  WindowWeights window_;
  WindowPlane whole_;  // weights where nothing is ignored, sum 1
  float whole_sq_;
};

}  // namespace

std::vector<PixelMatch> refineMatches(const MatchPicture& model, const MatchPicture& live,
                                      const std::vector<PixelMatch>& rough,
                                      const SubpixelOptions& options) {
  if (rough.empty()) return {};
  const Refiner refiner(model, live, options);
  std::vector<PixelMatch> moved = rough;
  std::vector<std::uint8_t> kept(rough.size(), 0);
  parallelRanges(static_cast<int>(rough.size()), 256, [&](int begin, int end) {
    const std::vector<std::uint8_t> held = refiner.refine(&moved[static_cast<std::size_t>(begin)],
                                                          static_cast<std::size_t>(end - begin));
    std::copy(held.begin(), held.end(), kept.begin() + begin);
  });
  std::vector<PixelMatch> refined;
  for (std::size_t k = 0; k < moved.size(); ++k)
    if (kept[k] != 0) refined.push_back(moved[k]);
  return refined;
}

}  // namespace softscope
