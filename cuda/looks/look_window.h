// cuda/looks/look_window.h: what the threads of a block compute together for a window of a first
// look, by the formulas and in the order of src/features/look_kernels.cpp.
#pragma once

#include <cstddef>

#include "cuda/device/kernel.h"
#include "cuda/looks/look_layout.h"

namespace softscope::cuda {

/// Eight sums of every quantity, of the pixels of each lane in the order of the CPU's registers.
struct LaneSums {
  static constexpr int kMost = triangleSize(kMapUnknowns) + kMapUnknowns;
  float lanes[kMost][kLookLanes];

  template <class Term>
  SOFTSCOPE_HD void add(int quantity, int lane, int values, const Term& term) {
    float sum = 0;
    SOFTSCOPE_UNROLL(8)
    for (int i = lane; i < values; i += kLookLanes) sum += term(i);
    lanes[quantity][lane] = sum;
  }
  SOFTSCOPE_HD double total(int quantity) const { return totalOfLanes(lanes[quantity]); }
};

/// What a block does next.
enum class LookMode : std::int32_t {
  kBegin,     // with a level
  kCount,     // the pixels at the place
  kDescribe,  // the look by its counted pixels
  kSample,    // the image at the place, and move
  kPredict,   // the error there
  kOver
};

/// Sums over boxes of place terms, right and down.
struct BoxSums {
  static constexpr int kSide = kLookSidePx + kBoxPx - 1;  // boxes that overlap the window
  static constexpr int kStride = 32, kRows = kSide + kBoxPx - 1, kBoxes = kSide * kStride;
  float across[2][kRows * kStride], squares[2][kBoxes];
};

/// Of one look's search.
struct LookState {
  static constexpr int kThreads = 128;
  static constexpr int kMargin = 24;               // as far as slopes reach beyond a window
  static constexpr int kStride = kLookValues + 8;  // planes side by side are in different banks

  LookMode mode;
  // Of the look.
  LookPlace expected;
  LookFind whole, find;  // at full size alone, and from the smallest size up
  std::int32_t level, comes_from_above;
  // Of the level.
  LookSearch search;
  LookPlace start;
  std::int32_t round, step, not_ignored;
  std::uint8_t gray[kLookValues], ignored[kLookValues];
  // Of the round.
  LookPlaces places;
  std::int32_t counted, changed, missed;
  LookFacts facts;
  LookSighting seen;
  LookShading shadings[kMapUnknowns];
  LaneSums sums;
  double noise[kMapUnknowns][kMapUnknowns];
  double per_term[2][kMapUnknowns];
  float terms_of[2][kMapUnknowns];

  float padded[kMargin + kLookValues + kMargin];  // the look's gray levels, or the difference
  float weights[kLookValues], first[kLookValues], values[kLookValues];
  float changes[kMapUnknowns][kStride];
  float slopes[2][kStride];  // then terms
  union {
    float noise_changes[kMapUnknowns][kStride];
    BoxSums boxed;
  };
  SOFTSCOPE_HD float* window() { return padded + kMargin; }
};

SOFTSCOPE_HD inline float xOf(int i) { return static_cast<float>(i % kLookSidePx - kLookHalfPx); }
SOFTSCOPE_HD inline float yOf(int i) { return static_cast<float>(i / kLookSidePx - kLookHalfPx); }

SOFTSCOPE_HD inline bool isWithin(const LookRoom& room, float right, float down) {
  return right >= room.left && right < room.right && down >= room.top && down < room.bottom;
}
SOFTSCOPE_HD inline const std::uint8_t* lookPixelAt(const std::uint8_t* from, int width,
                                                    const LookPlaces& places, float right,
                                                    float down) {
  const int column = places.u + static_cast<int>(std::floor(right));
  const int row = places.v + static_cast<int>(std::floor(down));
  return from + (static_cast<std::ptrdiff_t>(row) * width + column);
}
/// Of the three sums that a plane is fitted to.
SOFTSCOPE_HD inline float shadingTerm(int which, float weighted, float x, float y) {
  return which == 0 ? weighted : which == 1 ? weighted * x : weighted * y;
}
/// Of one slope, or the other: itself, times x, and times y.
SOFTSCOPE_HD inline int slopeOf(int change) { return change == 1 || change > 3 ? 1 : 0; }
SOFTSCOPE_HD inline int factorOf(int change) { return change < 2 ? 0 : change % 2 == 0 ? 1 : 2; }
SOFTSCOPE_HD inline float (*changesOf(LookState& shared))[LookState::kStride] {
  return shared.mode == LookMode::kDescribe ? shared.changes : shared.noise_changes;
}

SOFTSCOPE_HD inline void loadLook(int thread, const LookBytes::OfLevel& look, LookState& shared) {
  int not_ignored = 0;
  for (int i = thread; i < kLookValues; i += LookState::kThreads) {
    shared.gray[i] = i < kLookPixels ? look.gray[i] : 0;
    shared.ignored[i] = i < kLookPixels ? look.ignore[i] : 1;
    not_ignored += shared.ignored[i] == 0;
  }
  if (not_ignored > 0) atomicPlus(&shared.not_ignored, not_ignored);
}
SOFTSCOPE_HD inline void countPixels(int thread, const LookImageLevel& image, LookState& shared) {
  const LookPlaces& places = shared.places;
  const LookRoom room = roomAround(places, image.width, image.height, kLookRoomPx);
  int counted = 0, changed = 0;
  for (int i = thread; i < kLookValues; i += LookState::kThreads) {
    const float right = lookRight(places, xOf(i), yOf(i)), down = lookDown(places, xOf(i), yOf(i));
    bool counts = shared.ignored[i] == 0 && isWithin(room, right, down);
    if (counts && image.ignore != nullptr) {
      const std::uint8_t* above = lookPixelAt(image.ignore, image.width, places, right, down);
      const std::uint8_t* below = above + image.width;
      counts = (above[0] | above[1] | below[0] | below[1]) == 0;
    }
    const float weight = counts ? 1.0f : 0.0f;
    counted += counts;
    changed += shared.round == 0 || weight != shared.weights[i];
    shared.weights[i] = weight;
  }
  if (counted > 0) atomicPlus(&shared.counted, counted);
  if (changed > 0) atomicPlus(&shared.changed, changed);
}

/// Moments of the counted pixels, and sums of the gray levels.
SOFTSCOPE_HD inline void sumWindow(int thread, LookState& shared) {
  constexpr int kQuantities = 8;
  if (thread >= kQuantities * kLookLanes) return;
  const int quantity = thread / kLookLanes, lane = thread % kLookLanes;
  shared.sums.add(quantity, lane, kLookValues, [&](int i) {
    const float w = shared.weights[i], x = xOf(i), y = yOf(i);
    switch (quantity) {
      case 0:
        return w * x;
      case 1:
        return w * y;
      case 2:
        return w * x * x;
      case 3:
        return w * x * y;
      case 4:
        return w * y * y;
      default:
        return shadingTerm(quantity - 5, w * static_cast<float>(shared.gray[i]), x, y);
    }
  });
}
/// The look without its shading; or the difference between it and the image.
SOFTSCOPE_HD inline void takeWindow(int thread, LookState& shared) {
  const LookShading& shading = shared.shadings[0];
  const float scale = static_cast<float>(1 / shared.seen.deviation);  // unused in a description
  for (int k = thread; k < 2 * LookState::kMargin; k += LookState::kThreads)
    shared.padded[k < LookState::kMargin ? k : kLookValues + k] = 0;
  for (int i = thread; i < kLookValues; i += LookState::kThreads) {
    const float w = shared.weights[i], shade = shadingAt(shading, xOf(i), yOf(i));
    if (shared.mode == LookMode::kDescribe) {
      const float gray = static_cast<float>(shared.gray[i]);
      shared.window()[i] = gray;
      shared.first[i] = w * (gray - shade);
    } else {
      shared.window()[i] = w * (scale * (shared.values[i] - shade)) - shared.first[i];
    }
  }
}
SOFTSCOPE_HD inline void findSlopes(int thread, LookState& shared) {
  const double scale = shared.mode == LookMode::kDescribe ? 1 / shared.facts.contrast : 1;
  const float half = static_cast<float>(0.5 * scale);
  for (int i = thread; i < kLookValues; i += LookState::kThreads) {
    const int column = i % kLookSidePx, row = i / kLookSidePx;
    const bool edge =
        column == 0 || row == 0 || column == kLookSidePx - 1 || row == kLookSidePx - 1;
    const float inner = (edge ? 0.0f : 1.0f) * half;
    const float* here = shared.window() + i;
    shared.slopes[0][i] = inner * (here[1] - here[-1]);
    shared.slopes[1][i] = inner * (here[kLookSidePx] - here[-kLookSidePx]);
    if (shared.mode == LookMode::kDescribe)
      shared.first[i] = static_cast<float>(scale) * shared.first[i];
  }
}
SOFTSCOPE_HD inline void sumSlopes(int thread, LookState& shared) {
  constexpr int kPlane = 3;  // sums
  for (int job = thread; job < kMapUnknowns * kPlane * kLookLanes; job += LookState::kThreads) {
    const int lane = job % kLookLanes, quantity = job / kLookLanes;
    const int change = quantity / kPlane, which = quantity % kPlane;
    const float* slope = shared.slopes[slopeOf(change)];
    shared.sums.add(quantity, lane, kLookValues, [&](int i) {
      const float x = xOf(i), y = yOf(i);
      const float weighted = shadingTerm(factorOf(change), shared.weights[i] * slope[i], x, y);
      return shadingTerm(which, weighted, x, y);
    });
  }
}
SOFTSCOPE_HD inline void fitSlopes(int thread, LookState& shared) {
  if (thread >= kMapUnknowns) return;
  const LaneSums& sums = shared.sums;
  shared.shadings[thread] = shadingOf(shared.facts.shading.plane(
      sums.total(3 * thread), sums.total(3 * thread + 1), sums.total(3 * thread + 2)));
}
SOFTSCOPE_HD inline void findChanges(int thread, LookState& shared) {
  float(*to)[LookState::kStride] = changesOf(shared);
  for (int i = thread; i < kLookValues; i += LookState::kThreads) {
    const float w = shared.weights[i], x = xOf(i), y = yOf(i);
    for (int k = 0; k < kMapUnknowns; ++k)
      to[k][i] = w * (shadingTerm(factorOf(k), shared.slopes[slopeOf(k)][i], x, y) -
                      shadingAt(shared.shadings[k], x, y));
  }
}
/// The lower triangle of their products, and those with the look.
SOFTSCOPE_HD inline void sumChanges(int thread, LookState& shared) {
  constexpr int kProducts = triangleSize(kMapUnknowns);
  const float(*changes)[LookState::kStride] = changesOf(shared);
  const int quantities = shared.mode == LookMode::kDescribe ? kProducts + kMapUnknowns : kProducts;
  for (int job = thread; job < quantities * kLookLanes; job += LookState::kThreads) {
    const int lane = job % kLookLanes, quantity = job / kLookLanes;
    int row = 0;
    while (triangleSize(row + 1) <= quantity) ++row;
    const float* one = quantity < kProducts ? changes[row] : shared.first;
    const float* other =
        changes[quantity < kProducts ? quantity - triangleSize(row) : quantity - kProducts];
    shared.sums.add(quantity, lane, kLookValues, [&](int i) { return one[i] * other[i]; });
  }
}
SOFTSCOPE_HD inline void takeNormal(int thread, LookState& shared) {
  constexpr int kProducts = triangleSize(kMapUnknowns);
  auto& normal = shared.mode == LookMode::kDescribe ? shared.facts.normal : shared.noise;
  if (thread < kMapUnknowns * kMapUnknowns) {
    const int i = thread / kMapUnknowns, j = thread % kMapUnknowns;
    normal[i][j] = shared.sums.total(i < j ? triangleSize(j) + i : triangleSize(i) + j);
  } else if (thread < kMapUnknowns * (kMapUnknowns + 1) && shared.mode == LookMode::kDescribe) {
    const int k = thread - kMapUnknowns * kMapUnknowns;
    shared.facts.first_changes[k] = shared.sums.total(kProducts + k);
  }
}

SOFTSCOPE_HD inline void samplePixels(int thread, const LookImageLevel& image, LookState& shared) {
  const LookPlaces& places = shared.places;
  const LookRoom room = roomAround(places, image.width, image.height, 0);
  int missed = 0;
  for (int i = thread; i < kLookValues; i += LookState::kThreads) {
    const float right = lookRight(places, xOf(i), yOf(i)), down = lookDown(places, xOf(i), yOf(i));
    shared.values[i] = 0;
    if (isWithin(room, right, down)) {
      const std::uint8_t* above = lookPixelAt(image.gray, image.width, places, right, down);
      const std::uint8_t* below = above + image.width;
      shared.values[i] = lookSample(static_cast<float>(above[0]), static_cast<float>(above[1]),
                                    static_cast<float>(below[0]), static_cast<float>(below[1]),
                                    right - std::floor(right), down - std::floor(down)) -
                         shared.seen.middle;
    } else {
      missed += shared.weights[i] > 0;
    }
  }
  if (missed > 0) atomicPlus(&shared.missed, missed);
}
SOFTSCOPE_HD inline void sumSamples(int thread, LookState& shared) {
  constexpr int kQuantities = 5 + kMapUnknowns;
  if (thread >= kQuantities * kLookLanes) return;
  const int quantity = thread / kLookLanes, lane = thread % kLookLanes;
  shared.sums.add(quantity, lane, kLookValues, [&](int i) {
    const float value = shared.values[i], weighted = shared.weights[i] * value;
    if (quantity < 3) return shadingTerm(quantity, weighted, xOf(i), yOf(i));
    if (quantity == 3) return weighted * value;
    return value * (quantity == 4 ? shared.first[i] : shared.changes[quantity - 5][i]);
  });
}

SOFTSCOPE_HD inline void findTerms(int thread, LookState& shared) {
  for (int i = thread; i < kLookValues; i += LookState::kThreads)
    for (int axis = 0; axis < 2; ++axis) {
      float change = 0;
      for (int k = 0; k < kMapUnknowns; ++k)
        change += shared.terms_of[axis][k] * shared.changes[k][i];
      shared.slopes[axis][i] = shared.window()[i] * change;
    }
}
/// Over kBoxPx pixels of a row, for all boxes that hold one; rows above and below are 0.
SOFTSCOPE_HD inline void sumAcross(int thread, LookState& shared) {
  for (int job = thread; job < 2 * BoxSums::kRows * BoxSums::kStride; job += LookState::kThreads) {
    const int axis = job / (BoxSums::kRows * BoxSums::kStride),
              place = job % (BoxSums::kRows * BoxSums::kStride);
    const int y = place / BoxSums::kStride - (kBoxPx - 1),
              x = place % BoxSums::kStride - (kBoxPx - 1);
    float sum = 0;
    if (y >= 0 && y < kLookSidePx)
      for (int k = 0; k < kBoxPx; ++k)
        sum +=
            x + k >= 0 && x + k < kLookSidePx ? shared.slopes[axis][y * kLookSidePx + x + k] : 0.0f;
    shared.boxed.across[axis][place] = sum;
  }
}
SOFTSCOPE_HD inline void sumDown(int thread, LookState& shared) {
  for (int job = thread; job < 2 * BoxSums::kBoxes; job += LookState::kThreads) {
    const int axis = job / BoxSums::kBoxes, box = job % BoxSums::kBoxes;
    float sum = shared.boxed.across[axis][box];
    for (int k = 1; k < kBoxPx; ++k) sum += shared.boxed.across[axis][box + k * BoxSums::kStride];
    shared.boxed.squares[axis][box] = sum * sum;
  }
}

}  // namespace softscope::cuda
