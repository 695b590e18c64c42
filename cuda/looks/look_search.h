// cuda/looks/look_search.h: kernel bodies that find first looks in an image.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/device/squares.h"
#include "cuda/looks/look_window.h"

namespace softscope::cuda {

/// Half the width and height of the image and its mask.
struct HalveLookBody {
  View<const std::uint8_t> gray, ignore;  // without data nothing is ignored
  View<std::uint8_t> half_gray, half_ignore;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    half_gray.at(u, v) = meanOfSquare(gray, u, v);
    if (ignore.data != nullptr) half_ignore.at(u, v) = bitsOfSquare(ignore, u, v) != 0 ? 1 : 0;
  }
};

/// One block per look. A repeat is a step of its search: as in look_search.cpp and first_look.cpp,
/// with the formulas and sums of the CPU. What a phase of one thread decides holds from the next
/// phase on.
struct SearchLookKernel {
  static constexpr int kThreads = LookState::kThreads, kPhases = 22;
  using Shared = LookState;
  /// Of the first thread: where it alone runs, the others may not even look at the shared one.
  struct Local {
    LookMode mode;
  };

  const LookBytes* looks;
  const LookQuestion* questions;
  LookImageLevels image;
  LookFind* finds;

  SOFTSCOPE_HD int repeats(const Place&) const {
    constexpr int kOfLevel = kMostLookRounds * (kMostLookSteps + 2) + 2;
    return (kLookLevels + 1) * kOfLevel;
  }
  SOFTSCOPE_HD bool isOver(const Shared& shared) const { return shared.mode == LookMode::kOver; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    if constexpr (kPhase == 0) {
      if (at.thread == 0) open(at, shared, local);
    } else if constexpr (kPhase == 1) {
      if (shared.mode == LookMode::kBegin) loadLook(at.thread, lookOf(at, shared), shared);
    } else if constexpr (kPhase == 2) {
      if (at.thread == 0) beginCount(at, shared, local);
    } else if constexpr (kPhase == 3) {
      if (shared.mode == LookMode::kCount) countPixels(at.thread, imageOf(shared), shared);
    } else if constexpr (kPhase == 4) {
      if (at.thread == 0 && local.mode == LookMode::kCount) judgeCount(at, shared, local);
    } else if constexpr (kPhase == 5) {
      if (shared.mode == LookMode::kDescribe) sumWindow(at.thread, shared);
    } else if constexpr (kPhase == 6) {
      if (at.thread == 0) fitShading(at, shared, local);
    } else if constexpr (kPhase == 7) {
      if (findsChanges(shared)) takeWindow(at.thread, shared);
    } else if constexpr (kPhase == 8) {
      if (shared.mode == LookMode::kDescribe && at.thread < kLookLanes)
        shared.sums.add(0, at.thread, kLookValues,
                        [&](int i) { return shared.first[i] * shared.first[i]; });
    } else if constexpr (kPhase == 9) {
      if (at.thread == 0 && local.mode == LookMode::kDescribe) judgeContrast(at, shared, local);
    } else if constexpr (kPhase == 10) {
      if (findsChanges(shared)) findSlopes(at.thread, shared);
    } else if constexpr (kPhase == 11) {
      if (findsChanges(shared)) sumSlopes(at.thread, shared);
    } else if constexpr (kPhase == 12) {
      if (findsChanges(shared)) fitSlopes(at.thread, shared);
    } else if constexpr (kPhase == 13) {
      if (findsChanges(shared)) findChanges(at.thread, shared);
    } else if constexpr (kPhase == 14) {
      if (findsChanges(shared)) sumChanges(at.thread, shared);
    } else if constexpr (kPhase == 15) {
      if (findsChanges(shared)) takeNormal(at.thread, shared);
    } else if constexpr (kPhase == 16) {
      if (at.thread == 0) beginSample(at, shared, local);
    } else if constexpr (kPhase == 17) {
      if (shared.mode == LookMode::kSample) samplePixels(at.thread, imageOf(shared), shared);
      if (shared.mode == LookMode::kPredict) findTerms(at.thread, shared);
    } else if constexpr (kPhase == 18) {
      if (shared.mode == LookMode::kSample) sumSamples(at.thread, shared);
      if (shared.mode == LookMode::kPredict) sumAcross(at.thread, shared);
    } else if constexpr (kPhase == 19) {
      if (shared.mode == LookMode::kPredict) sumDown(at.thread, shared);
    } else if constexpr (kPhase == 20) {
      if (shared.mode == LookMode::kPredict && at.thread < 2 * kLookLanes)
        shared.sums.add(at.thread / kLookLanes, at.thread % kLookLanes, BoxSums::kBoxes,
                        [&](int i) { return shared.boxed.squares[at.thread / kLookLanes][i]; });
    } else {
      if (at.thread != 0) return;
      if (local.mode == LookMode::kSample)
        move(at, shared, local);
      else if (local.mode == LookMode::kPredict)
        predict(at, shared, local);
    }
  }

 private:
  /// Of the look, or of what differs from it.
  SOFTSCOPE_HD static bool findsChanges(const Shared& shared) {
    return shared.mode == LookMode::kDescribe || shared.mode == LookMode::kPredict;
  }
  SOFTSCOPE_HD const LookBytes::OfLevel& lookOf(const Place& at, const Shared& shared) const {
    return looks[questions[at.x].number].levels[shared.level];
  }
  SOFTSCOPE_HD const LookImageLevel& imageOf(const Shared& shared) const {
    return image.at[shared.level];
  }

  SOFTSCOPE_HD static void setMode(LookMode mode, Shared& shared, Local& local) {
    shared.mode = local.mode = mode;
  }
  SOFTSCOPE_HD void open(const Place& at, Shared& shared, Local& local) const {
    if (at.repeat == 0) {
      shared.expected = questions[at.x].expected;
      shared.find = noFind(shared.expected);
      shared.level = shared.comes_from_above = 0;
      setMode(LookMode::kBegin, shared, local);
    }
    if (local.mode == LookMode::kBegin) {
      shared.search = searchFrom(placeInLevel(shared.find.place, shared.level));
      shared.start = shared.search.place;
      for (int k = 0; k < 4; ++k) shared.start.map[k] = shared.expected.map[k];
      shared.round = shared.not_ignored = 0;
    }
    shared.counted = shared.changed = shared.missed = 0;
  }
  SOFTSCOPE_HD void beginCount(const Place& at, Shared& shared, Local& local) const {
    if (local.mode == LookMode::kBegin) {
      if (lookOf(at, shared).taken == 0) return endLevel(at, shared, local, false);
      setMode(LookMode::kCount, shared, local);
    }
    if (local.mode != LookMode::kCount) return;
    if (isInside(shared.search.place, imageOf(shared).width, imageOf(shared).height))
      shared.places = placesOf(shared.search.place);
    else if (shared.round == 0)
      endLevel(at, shared, local, false);
    else
      setMode(LookMode::kPredict, shared, local);
  }
  SOFTSCOPE_HD void judgeCount(const Place& at, Shared& shared, Local& local) const {
    const double least = kLeastLookShare * static_cast<double>(shared.not_ignored);
    if (shared.round > 0 && shared.changed == 0) {
      setMode(LookMode::kPredict, shared, local);
    } else if (!(static_cast<double>(shared.counted) >= least)) {
      endLevel(at, shared, local, false);
    } else {
      shared.facts.count = shared.counted;
      setMode(LookMode::kDescribe, shared, local);
      shared.step = 0;
      ++shared.round;
    }
  }
  SOFTSCOPE_HD void fitShading(const Place& at, Shared& shared, Local& local) const {
    const LaneSums& sums = shared.sums;
    if (local.mode == LookMode::kDescribe) {
      LookFacts& facts = shared.facts;
      facts.shading = ShadingFit(
          {facts.count, sums.total(0), sums.total(1), sums.total(2), sums.total(3), sums.total(4)});
      shared.shadings[0] =
          shadingOf(facts.shading.plane(sums.total(5), sums.total(6), sums.total(7)));
    } else if (local.mode == LookMode::kPredict) {
      shared.search.converged = true;
      if (shared.search.correlation < kLeastLookCorrelation)
        endLevel(at, shared, local, false);
      else
        shared.shadings[0] = shadingOf(shared.seen.shading);
    }
  }
  SOFTSCOPE_HD void judgeContrast(const Place& at, Shared& shared, Local& local) const {
    shared.facts.contrast = std::sqrt(shared.sums.total(0) / shared.facts.count);
    if (!(shared.facts.contrast >= kLeastLookContrast)) endLevel(at, shared, local, false);
  }
  SOFTSCOPE_HD void beginSample(const Place& at, Shared& shared, Local& local) const {
    if (local.mode == LookMode::kDescribe) setMode(LookMode::kSample, shared, local);
    const LookImageLevel& image_here = imageOf(shared);
    if (local.mode == LookMode::kSample) {
      if (!isInside(shared.search.place, image_here.width, image_here.height))
        return endLevel(at, shared, local, false);
      shared.places = placesOf(shared.search.place);
      shared.seen.middle = static_cast<float>(
          image_here.gray[static_cast<std::ptrdiff_t>(shared.places.v) * image_here.width +
                          shared.places.u]);
    } else if (local.mode == LookMode::kPredict) {
      if (!placePerTerm(shared.facts, shared.noise, lookVariance(shared.search.correlation),
                        shared.per_term))
        return endLevel(at, shared, local, false);
      for (int axis = 0; axis < 2; ++axis)
        for (int k = 0; k < kMapUnknowns; ++k)
          shared.terms_of[axis][k] = static_cast<float>(shared.per_term[axis][k]);
    }
  }
  SOFTSCOPE_HD void move(const Place& at, Shared& shared, Local& local) const {
    const LaneSums& sums = shared.sums;
    LookSighting& seen = shared.seen;
    if (shared.missed != 0) return endLevel(at, shared, local, false);
    seen.deviation = std::sqrt(takeShading(shared.facts, sums.total(0), sums.total(1),
                                           sums.total(2), sums.total(3), &seen));
    seen.with_first = sums.total(4);
    for (int k = 0; k < kMapUnknowns; ++k) seen.with_changes[k] = sums.total(5 + k);
    if (!(seen.deviation > 0)) return endLevel(at, shared, local, false);
    shared.search.correlation = correlationOf(shared.facts, seen);
    LookStep step = LookStep::kConverged;
    if (shared.step < kMostLookSteps)
      step = stepLook(shared.facts, seen, shared.start, shared.search.correlation,
                      &shared.search.place);
    ++shared.step;
    if (step == LookStep::kLost) return endLevel(at, shared, local, false);
    if (step == LookStep::kConverged)
      setMode(shared.round == kMostLookRounds ? LookMode::kPredict : LookMode::kCount, shared,
              local);
  }
  SOFTSCOPE_HD void predict(const Place& at, Shared& shared, Local& local) const {
    const double boxes[2] = {shared.sums.total(0), shared.sums.total(1)};
    shared.search.sigma_px =
        lookSigma(shared.facts, lookVariance(shared.search.correlation), shared.per_term, boxes);
    endLevel(at, shared, local, shared.search.sigma_px <= kLargestLookSigmaPx);
  }
  SOFTSCOPE_HD void endLevel(const Place& at, Shared& shared, Local& local, bool found) const {
    addLevel(shared.search, found, shared.level, &shared.find);
    setMode(LookMode::kBegin, shared, local);
    if (shared.comes_from_above != 0) {
      if (shared.level > 0) {
        --shared.level;
        if (shared.level > 0 || shared.find.found) return;
      }
      finds[at.x] = shared.find.found ? shared.find : shared.whole;
      setMode(LookMode::kOver, shared, local);
    } else if (found) {
      finds[at.x] = shared.find;
      setMode(LookMode::kOver, shared, local);
    } else {
      shared.whole = shared.find;
      shared.find = noFind(shared.expected);
      shared.level = kLookLevels - 1;
      shared.comes_from_above = 1;
    }
  }
};

}  // namespace softscope::cuda
