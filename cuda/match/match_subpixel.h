// cuda/match/match_subpixel.h: kernel body of the sub-pixel refinement.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "cuda/match/match_images.h"
#include "cuda/match/match_search.h"
#include "features/subpixel_formulas.h"

namespace softscope::cuda {

/// Images of the windows of a level, smoothed.
struct RefineLevel {
  View<const float> model, live, anchor;
  View<const std::uint8_t> model_ignore, live_ignore;
  const SlotMatch* rough;
  SlotMatch* refined;
  int slot_count;
};

/// Matches of all levels; kWindowLanes threads per match, one thread per column of its window:
/// first with the template of the anchor, then, if undecided, with that of the current image. Sums
/// that the CPU computes pixel by pixel are computed by one thread, several sums in parallel.
struct RefineKernel {
  static constexpr int kMatches = 8, kThreads = kMatches * kWindowLanes;
  static constexpr int kRadius = SubpixelOptions::kRadiusPx, kSide = 2 * kRadius + 1;
  static constexpr int kIterations = SubpixelOptions::kIterations;
  static constexpr int kSetUp = 9, kPhases = kSetUp + 2 * kIterations + 2;
  static_assert(kSide <= kLargestWindow && kSide < kWindowLanes, "the last lane is free");
  enum State : int { kLost, kRunning, kThere };
  struct Outcome {
    int held;  // not refused
    float live_u, live_v, sigma_px, similarity;
  };
  struct alignas(16) Match {
    float steepest_u[kSide * kWindowLanes], steepest_v[kSide * kWindowLanes];
    float contrast[kSide * kWindowLanes], weight[kSide * kWindowLanes];
    float sums[5][kWindowLanes];
    SlotMatch rough;
    int u, v;              // of the centre of the model window
    float rest_u, rest_v;  // from there to the match
    WindowMoments moments;
    WindowMatrix information;
    WindowSearch search;
    Outcome anchored;
    int state, decided;
  };
  struct Shared {
    Match matches[kMatches];
  };
  using Local = Nothing;

  RefineLevel levels[kMostMatchLevels];
  int level_count;
  const MatchInputs* inputs;
  WindowWeights window;

  /// Each level has its own blocks.
  Grid blocks() const {
    int count = 0;
    for (int k = 0; k < level_count; ++k) count += blocksFor(levels[k].slot_count, kMatches);
    return {count, 1, 1};
  }
  SOFTSCOPE_HD int repeats(const Place&) const { return inputs->has_anchor != 0 ? 2 : 1; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    int block = at.x, k = 0;
    for (; k + 1 < level_count; ++k) {
      const int count = (levels[k].slot_count + kMatches - 1) / kMatches;
      if (block < count) break;
      block -= count;
    }
    const RefineLevel& level = levels[k];
    const int slot = block * kMatches + at.thread / kWindowLanes, lane = at.thread % kWindowLanes;
    if (slot >= level.slot_count) return;
    Match& match = shared.matches[at.thread / kWindowLanes];
    const bool by_anchor = at.repeat + 1 < repeats(at);
    // The state is read while no other thread changes it.
    constexpr bool kAlone = kPhase == 0 || kPhase == 2 || kPhase == kPhases - 1 ||
                            (kPhase > kSetUp && (kPhase - kSetUp) % 2 == 1);
    if (kAlone && lane != 0) return;
    if constexpr (kPhase == 0) {
      begin(level, slot, at.repeat, match);
      return;
    }
    if constexpr (kPhase == kPhases - 1) {
      finish(level, slot, by_anchor, at.repeat, match);
      return;
    }
    if (match.state == kLost) return;
    if constexpr (kPhase == 1) {
      weigh(level, lane, match);
    } else if constexpr (kPhase == 2) {
      sumWeights(match);
    } else if constexpr (kPhase == 3) {
      differentiate(by_anchor ? level.anchor : level.model, lane, match);
    } else if constexpr (kPhase == 4) {
      sumMeans(lane, match);
    } else if constexpr (kPhase == 5) {
      sumProducts(lane, match);
    } else if constexpr (kPhase == 6) {
      project(lane, match);
    } else if constexpr (kPhase == 7) {
      sumInformation(lane, match);
    } else if constexpr (kPhase == 8) {
      makeTemplate(lane, match);
    } else if constexpr ((kPhase - kSetUp) % 2 == 0) {
      constexpr bool kLast = kPhase == kPhases - 2;
      if (kLast || match.state == kRunning) sample(level.live, lane, match);
    } else if (match.state == kRunning) {
      step(level.live, match);
    }
  }

 private:
  struct Four {
    float values[4];
  };
  /// Four values with one load.
  SOFTSCOPE_HD static Four four(const float* from) {
    Four loaded;
    __builtin_memcpy(&loaded, __builtin_assume_aligned(from, 16), sizeof loaded);
    return loaded;
  }
  /// Sum over a plane in order; `termsAt(k, terms)` returns four values.
  template <class TermsAt>
  SOFTSCOPE_HD static float sumOfFours(const TermsAt& termsAt) {
    float sum = 0;
    SOFTSCOPE_UNROLL(4)
    for (int k = 0; k < kSide * kWindowLanes; k += 4) {
      float terms[4];
      termsAt(k, terms);
      for (int i = 0; i < 4; ++i) sum += terms[i];
    }
    return sum;
  }
  SOFTSCOPE_HD static float sumOf(const float* values, int count) {
    float sum = 0;
    SOFTSCOPE_UNROLL(16)
    for (int k = 0; k < count; ++k) sum += values[k];
    return sum;
  }

  SOFTSCOPE_HD static void begin(const RefineLevel& level, int slot, int repeat, Match& match) {
    if (repeat == 0) {
      match.rough = level.rough[slot];
      match.decided = 0;
      match.anchored = {0, 0, 0, 0, 0};
    }
    match.state = kLost;
    if (match.rough.found == 0 || match.decided != 0) return;
    match.u = static_cast<int>(std::lround(match.rough.model_u));
    match.v = static_cast<int>(std::lround(match.rough.model_v));
    if (!isInsideModel(match.u, match.v, kRadius, level.model.width, level.model.height)) return;
    match.rest_u = match.rough.model_u - static_cast<float>(match.u);
    match.rest_v = match.rough.model_v - static_cast<float>(match.v);
    match.search = {};
    match.search.u = match.search.start_u = match.rough.live_u - match.rest_u;
    match.search.v = match.search.start_v = match.rough.live_v - match.rest_v;
    if (isInsideLive(match.search.u, match.search.v, kRadius, level.live.width, level.live.height))
      match.state = kRunning;
  }

  /// Weights of a column without pixels ignored in either image.
  SOFTSCOPE_HD void weigh(const RefineLevel& level, int lane, Match& match) const {
    const int lu = static_cast<int>(std::lround(match.search.u)) - kRadius + lane,
              lv = static_cast<int>(std::lround(match.search.v)) - kRadius;
    for (int y = 0; y < kSide; ++y) {
      const int k = y * kWindowLanes + lane;
      const bool ignored =
          lane >= kSide ||
          level.model_ignore.at(match.u - kRadius + lane, match.v - kRadius + y) != 0 ||
          (level.live_ignore.contains(lu, lv + y) && level.live_ignore.at(lu, lv + y) != 0);
      match.weight[k] = ignored ? 0.0f : window.values[k];
    }
  }
  SOFTSCOPE_HD void sumWeights(Match& match) const {
    const float kept = sumOfFours([&](int k, float(&terms)[4]) {
      const Four w = four(match.weight + k);
      for (int i = 0; i < 4; ++i) terms[i] = w.values[i];
    });
    if (!(kept >= kLeastWindowShare * window.all)) match.state = kLost;
    match.moments = {};
    match.moments.square = kept;  // until the weights are divided by it
  }
  SOFTSCOPE_HD static void differentiate(const View<const float>& image, int lane, Match& match) {
    for (int y = 0; y < kSide; ++y) {
      const int k = y * kWindowLanes + lane;
      match.weight[k] /= match.moments.square;
      if (lane >= kSide) {
        match.contrast[k] = match.steepest_u[k] = match.steepest_v[k] = 0;
        continue;
      }
      const float* pixel = image.row(match.v - kRadius + y) + match.u - kRadius + lane;
      match.contrast[k] = *pixel;
      match.steepest_u[k] = 0.5f * (pixel[1] - pixel[-1]);
      match.steepest_v[k] = 0.5f * (pixel[image.stride] - pixel[-image.stride]);
    }
  }
  /// Lane 0: squared weights; lanes 1 to 3: means of brightness and gradients.
  SOFTSCOPE_HD static void sumMeans(int lane, Match& match) {
    if (lane > 3) return;
    const float* values = lane == 0   ? match.weight
                          : lane == 1 ? match.contrast
                          : lane == 2 ? match.steepest_u
                                      : match.steepest_v;
    const float sum = sumOfFours([&](int k, float(&terms)[4]) {
      const Four w = four(match.weight + k), x = four(values + k);
      for (int i = 0; i < 4; ++i) terms[i] = w.values[i] * x.values[i];
    });
    float* const to[] = {&match.search.weight_sq, &match.moments.mean, &match.moments.gradient_u,
                         &match.moments.gradient_v};
    *to[lane] = sum;
  }
  /// Products of the contrast with itself and with the gradients.
  SOFTSCOPE_HD static void sumProducts(int lane, Match& match) {
    if (lane > 2) return;
    const float* values = lane == 0   ? match.contrast
                          : lane == 1 ? match.steepest_u
                                      : match.steepest_v;
    const float means[] = {match.moments.mean, match.moments.gradient_u, match.moments.gradient_v};
    const float mean = match.moments.mean, other_mean = means[lane];
    const float sum = sumOfFours([&](int k, float(&terms)[4]) {
      const Four w = four(match.weight + k), x = four(match.contrast + k), y = four(values + k);
      for (int i = 0; i < 4; ++i)
        terms[i] = w.values[i] * (x.values[i] - mean) * (y.values[i] - other_mean);
    });
    float* const to[] = {&match.moments.square, &match.moments.along_u, &match.moments.along_v};
    *to[lane] = sum;
  }
  SOFTSCOPE_HD static void project(int lane, Match& match) {
    const WindowMoments& m = match.moments;
    for (int y = 0; y < kSide; ++y) {
      const int k = y * kWindowLanes + lane;
      const float contrast = match.contrast[k] - m.mean;
      match.steepest_u[k] =
          projectedGradient(match.steepest_u[k], m.gradient_u, contrast, m.along_u, m.square);
      match.steepest_v[k] =
          projectedGradient(match.steepest_v[k], m.gradient_v, contrast, m.along_v, m.square);
      match.contrast[k] = contrast;
    }
  }
  SOFTSCOPE_HD static void sumInformation(int lane, Match& match) {
    if (lane > 3) return;
    const float* a = lane < 2 ? match.steepest_u : match.steepest_v;
    const float* b = lane % 2 == 0 ? match.steepest_u : match.steepest_v;
    const float sum = sumOfFours([&](int k, float(&terms)[4]) {
      const Four w = four(match.weight + k), x = four(a + k), y = four(b + k);
      for (int i = 0; i < 4; ++i) terms[i] = w.values[i] * x.values[i] * y.values[i];
    });
    float* const to[] = {&match.information.uu, &match.information.uv, &match.information.vu,
                         &match.information.vv};
    *to[lane] = sum;
  }
  SOFTSCOPE_HD static void makeTemplate(int lane, Match& match) {
    for (int y = 0; y < kSide; ++y) {
      const int k = y * kWindowLanes + lane;
      match.steepest_u[k] *= match.weight[k];
      match.steepest_v[k] *= match.weight[k];
      match.contrast[k] *= match.weight[k];
    }
    if (lane != kWindowLanes - 1) return;
    match.search.contrast_sq = match.moments.square;
    match.search.inverse = inverseOf(match.information);
  }

  /// One column of the live window at the current position.
  SOFTSCOPE_HD static void sample(const View<const float>& live, int lane, Match& match) {
    const float u = match.search.u - static_cast<float>(kRadius),
                v = match.search.v - static_cast<float>(kRadius);
    const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
    const float across = u - static_cast<float>(u0), down = v - static_cast<float>(v0);
    const float* corner = live.row(v0) + u0 + lane;
    float along_u = 0, along_v = 0, contrast = 0, mean = 0, square = 0;
    float upper[2] = {corner[0], corner[1]};
    SOFTSCOPE_UNROLL(5)
    for (int y = 0; y < kSide; ++y) {
      const float* below = corner + static_cast<std::ptrdiff_t>(y + 1) * live.stride;
      const float lower[2] = {below[0], below[1]};
      const float value = bilinear(upper[0], upper[1], lower[0], lower[1], across, down);
      const int k = y * kWindowLanes + lane;
      along_u += match.steepest_u[k] * value;
      along_v += match.steepest_v[k] * value;
      contrast += match.contrast[k] * value;
      mean += match.weight[k] * value;
      square += match.weight[k] * value * value;
      upper[0] = lower[0];
      upper[1] = lower[1];
    }
    match.sums[0][lane] = along_u;
    match.sums[1][lane] = along_v;
    match.sums[2][lane] = contrast;
    match.sums[3][lane] = mean;
    match.sums[4][lane] = square;
  }
  SOFTSCOPE_HD static WindowSums sumsOf(const Match& match) {
    return {sumOf(match.sums[0], kWindowLanes), sumOf(match.sums[1], kWindowLanes),
            sumOf(match.sums[2], kWindowLanes), sumOf(match.sums[3], kWindowLanes),
            sumOf(match.sums[4], kWindowLanes)};
  }
  SOFTSCOPE_HD static void step(const View<const float>& live, Match& match) {
    // The tests of the template are here, where one thread decides.
    if (!(match.moments.square > kLeastContrastSq) ||
        !(determinantOf(match.information) > kLeastDeterminant)) {
      match.state = kLost;
      return;
    }
    const SearchStep taken =
        takeStep(sumsOf(match), static_cast<float>(SubpixelOptions::kMaxShiftPx), kRadius,
                 live.width, live.height, &match.search);
    if (taken == SearchStep::kRefused) match.state = kLost;
    if (taken == SearchStep::kConverged) match.state = kThere;
  }

  SOFTSCOPE_HD static void finish(const RefineLevel& level, int slot, bool by_anchor, int repeat,
                                  Match& match) {
    if (match.decided != 0) return;
    Outcome found{0, 0, 0, 0, 0};
    if (match.state != kLost) {
      const WindowVerdict verdict = classifyWindow(
          sumsOf(match), match.search, static_cast<float>(SubpixelOptions::kFloorSigmaPx),
          static_cast<float>(SubpixelOptions::kMinSimilarity));
      found = {verdict.accepted ? 1 : 0, match.search.u + match.rest_u,
               match.search.v + match.rest_v, verdict.sigma_px, verdict.similarity};
    }
    if (by_anchor) {
      match.anchored = found;
      if (anchorDecides(found.held != 0, found.sigma_px,
                        static_cast<float>(SubpixelOptions::kMaxSigmaPx)))
        store(level.refined[slot], found, match);
      return;
    }
    if (repeat > 0) {
      found.sigma_px = quadratureSum(found.sigma_px, static_cast<float>(SubpixelOptions::kDriftPx));
      if (anchorIsBetter(match.anchored.held != 0, match.anchored.sigma_px, found.held != 0,
                         found.sigma_px))
        found = match.anchored;
    }
    store(level.refined[slot], found, match);
  }
  SOFTSCOPE_HD static void store(SlotMatch& refined, const Outcome& found, Match& match) {
    match.decided = 1;
    refined = {match.rough.model_u, match.rough.model_v, found.live_u,           found.live_v,
               found.sigma_px,      found.similarity,    found.held != 0 ? 1 : 0};
  }
};

}  // namespace softscope::cuda
