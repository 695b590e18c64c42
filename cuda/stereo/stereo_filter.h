// cuda/stereo/stereo_filter.h: kernel bodies that remove invalid disparities, close small gaps, and
// combine pyramid levels.
#pragma once

#include "core/image.h"
#include "cuda/device/kernel.h"
#include "cuda/device/squares.h"
#include "cuda/stereo/stereo_ignored.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope::cuda {

/// Sets `count` values.
template <class T>
struct FillKernel {
  static constexpr int kThreads = 256, kPhases = 1, kEach = 4;
  using Shared = Nothing;
  using Local = Nothing;
  T* values;
  int count;
  T value;

  Grid blocks() const { return {blocksFor(count, kThreads * kEach), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    for (int k = 0; k < kEach; ++k) {
      const int i = (at.x * kEach + k) * kThreads + at.thread;
      if (i < count) values[i] = value;
    }
  }
};

/// Means of 2 x 2 pixels, rounded.
struct HalveBody {
  View<const std::uint8_t> whole[2];
  View<std::uint8_t> half[2];
  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    half[view].at(u, v) = meanOfSquare(whole[view], u, v);
  }
};

/// 1 for pixels with a pixel of the row within the reach darker than the limit.
struct DarkRowBody {
  View<const std::uint8_t> gray;
  View<std::uint8_t> out;
  int darkest_gray, reach;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    std::uint8_t found = 0;
    for (int x = u - reach; x <= u + reach; ++x)
      if (x >= 0 && x < gray.width) found |= gray.at(x, v) < darkest_gray;
    out.at(u, v) = found;
  }
};

/// 1 for pixels with a mark within the reach along the row.
struct SpreadRowBody {
  View<const std::uint8_t> marks;
  View<std::uint8_t> out;
  int reach;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    std::uint8_t found = 0;
    for (int x = u - reach; x <= u + reach; ++x)
      if (x >= 0 && x < marks.width) found |= marks.at(x, v);
    out.at(u, v) = found;
  }
};
SOFTSCOPE_HD inline bool isMarkedInColumn(const View<const std::uint8_t>& marks, int u, int v,
                                          int reach) {
  std::uint8_t found = 0;
  for (int y = v - reach; y <= v + reach; ++y)
    if (y >= 0 && y < marks.height) found |= marks.at(u, y);
  return found != 0;
}

/// Left disparities confirmed by the right view, without dark pixels.
struct LeftRightBody {
  View<const std::int16_t> left, right;
  View<const std::uint8_t> dark_rows;
  View<float> out;
  int tolerance_px, dark_reach;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int d = left.at(u, v);
    const bool confirmed = d >= 0 && u - d >= 0 &&
                           confirmsDisparity(d, right.at(u - d, v), tolerance_px) &&
                           !isMarkedInColumn(dark_rows, u, v, dark_reach);
    out.at(u, v) = confirmed ? static_cast<float>(d) : quietNan();
  }
};

/// Copy without dark or ignored pixels; the level keeps its result.
struct DropDarkBody {
  View<const float> disparity_in, sigma_in;
  View<const std::uint8_t> dark_rows, ignored;
  View<float> disparity, sigma;
  int dark_reach;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const bool dark =
        (ignored.at(u, v) & Ignored::kMasked) != 0 || isMarkedInColumn(dark_rows, u, v, dark_reach);
    disparity.at(u, v) = dark ? quietNan() : disparity_in.at(u, v);
    sigma.at(u, v) = sigma_in.at(u, v);
  }
};

// --- islands: labels of connected pixels
// -----------------------------------------------------------

SOFTSCOPE_HD inline bool touches(float a, float b, float step) { return absoluteOf(a - b) <= step; }

/// Root of a label: the smallest index joined so far. An
/// outdated value is an older ancestor, which is equivalent.
SOFTSCOPE_HD inline int rootOf(const int* labels, int place) {
  const volatile int* fresh = labels;
  for (int label = fresh[place]; label != place; label = fresh[place]) place = label;
  return place;
}
SOFTSCOPE_HD inline void join(int* labels, int a, int b) {
  while (true) {
    a = rootOf(labels, a);
    b = rootOf(labels, b);
    if (a == b) return;
    if (a < b) {
      const int swapped = a;
      a = b;
      b = swapped;
    }
    const int before = atomicLeast(&labels[a], b);
    if (before == a) return;
    a = before;
  }
}

struct Islands {
  View<float> disparity_px;
  int* labels;  // index of a pixel, or of one joined to it
  int* sizes;   // at the roots of tiles: pixels
  float step;
  int least_px;

  SOFTSCOPE_HD int place(int u, int v) const { return v * disparity_px.width + u; }
};

/// Islands within each tile of 32 x 16 pixels, labelled by image index.
struct TileIslandsKernel {
  static constexpr int kThreads = 256, kPhases = 6, kWidth = 32, kHeight = 16;
  static constexpr int kPixels = kWidth * kHeight;
  struct Shared {
    float disparity[kPixels];
    std::uint32_t joined[kHeight];  // bit x: with the pixel to its left
    int labels[kPixels], sizes[kPixels];
  };
  using Local = Nothing;
  Islands islands;

  Grid blocks() const {
    return {blocksFor(islands.disparity_px.width, kWidth),
            blocksFor(islands.disparity_px.height, kHeight), 1};
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    for (int i = at.thread; i < kPixels; i += kThreads) {
      const int x = i % kWidth, y = i / kWidth;
      const int u = at.x * kWidth + x, v = at.y * kHeight + y;
      const float* d = shared.disparity + i;
      if constexpr (kPhase == 0) {
        shared.disparity[i] =
            islands.disparity_px.contains(u, v) ? islands.disparity_px.at(u, v) : quietNan();
        shared.sizes[i] = 0;
        if (x == 0) shared.joined[y] = 0;
      } else if constexpr (kPhase == 1) {
        if (x > 0 && touches(d[0], d[-1], islands.step))
          atomicUnite(&shared.joined[y], std::uint32_t{1} << x);
      } else if constexpr (kPhase == 2) {
        shared.labels[i] = y * kWidth + runBegin(shared.joined[y], x);
      } else if constexpr (kPhase == 3) {
        // One of the pairs of touching runs is sufficient.
        if (y > 0 && touches(d[0], d[-kWidth], islands.step) &&
            !(x > 0 && (shared.joined[y] & shared.joined[y - 1]) >> x & 1 &&
              touches(d[-1], d[-1 - kWidth], islands.step)))
          join(shared.labels, i, i - kWidth);
      } else if constexpr (kPhase == 4) {
        if (isNumber(d[0]) && runBegin(shared.joined[y], x) == x)
          atomicPlus(&shared.sizes[rootOf(shared.labels, i)], runLength(shared.joined[y], x));
      } else if (islands.disparity_px.contains(u, v)) {
        const int root = rootOf(shared.labels, i);
        islands.labels[islands.place(u, v)] =
            islands.place(at.x * kWidth + root % kWidth, at.y * kHeight + root / kWidth);
        islands.sizes[islands.place(u, v)] = shared.sizes[i];
      }
    }
  }

 private:
  SOFTSCOPE_HD static int runBegin(std::uint32_t joined, int x) {
    while ((joined >> x & 1) != 0) --x;
    return x;
  }
  SOFTSCOPE_HD static int runLength(std::uint32_t joined, int x) {
    int end = x + 1;
    while (end < kWidth && (joined >> end & 1) != 0) ++end;
    return end - x;
  }
};

/// Joins islands across the borders of tiles: blocks in z: 0 upper borders, 1 left borders.
struct JoinTilesBody {
  Islands islands;
  SOFTSCOPE_HD void operator()(int along, int border, int direction) const {
    const bool is_row = direction == 0;
    const int u = is_row ? along : (border + 1) * TileIslandsKernel::kWidth;
    const int v = is_row ? (border + 1) * TileIslandsKernel::kHeight : along;
    if (!islands.disparity_px.contains(u, v)) return;
    const View<float>& d = islands.disparity_px;
    const float here = d.at(u, v), there = is_row ? d.at(u, v - 1) : d.at(u - 1, v);
    if (!touches(here, there, islands.step)) return;
    const int before_u = is_row ? u - 1 : u, before_v = is_row ? v : v - 1;
    const int tile = is_row ? TileIslandsKernel::kWidth : TileIslandsKernel::kHeight;
    if (along % tile != 0) {  // one of the pairs of touching runs is sufficient
      const float here_before = d.at(before_u, before_v),
                  there_before =
                      is_row ? d.at(before_u, before_v - 1) : d.at(before_u - 1, before_v);
      if (touches(here, here_before, islands.step) && touches(there, there_before, islands.step) &&
          touches(here_before, there_before, islands.step))
        return;
    }
    join(islands.labels, islands.place(u, v),
         is_row ? islands.place(u, v - 1) : islands.place(u - 1, v));
  }
};

/// Adds the sizes of the islands of tiles at their common root.
struct SumIslandsBody {
  Islands islands;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int place = islands.place(u, v);
    const int label = islands.labels[place];
    if (label == place) return;  // its own size is there already
    const int size = islands.sizes[place];
    if (size == 0) return;  // no root of a tile
    atomicPlus(&islands.sizes[rootOf(islands.labels, label)], size);
  }
};
struct DropIslandsBody {
  Islands islands;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int place = islands.place(u, v);
    if (islands.sizes[rootOf(islands.labels, place)] < islands.least_px)
      islands.disparity_px.at(u, v) = quietNan();
  }
};

// --- gaps ----------------------------------------------------------------------------------------

/// Fills gaps of up to `widest` pixels along one axis, if both sides differ by
/// at most `step`; along columns, in the second pass, removes ignored pixels.
struct FillGapsBody {
  View<const float> in;
  View<float> out;
  View<const std::uint8_t> ignored;
  int widest;
  float step;
  bool along_rows;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    float value = in.at(u, v);
    if (!isNumber(value)) value = between(u, v, value);
    if (!along_rows && (ignored.at(u, v) & Ignored::kMasked) != 0) value = quietNan();
    out.at(u, v) = value;
  }

 private:
  SOFTSCOPE_HD float between(int u, int v, float unmeasured) const {
    const int length = along_rows ? in.width : in.height, at = along_rows ? u : v;
    const auto valueAt = [&](int i) { return along_rows ? in.at(i, v) : in.at(u, i); };
    int last = at - 1, next = at + 1;
    while (last >= 0 && at - last <= widest && !isNumber(valueAt(last))) --last;
    if (last < 0 || at - last > widest) return unmeasured;
    while (next < length && next - last - 1 <= widest && !isNumber(valueAt(next))) ++next;
    const int gap = next - last - 1;
    if (next >= length || gap > widest) return unmeasured;
    const float before = valueAt(last), after = valueAt(next);
    return absoluteOf(after - before) <= step ? gapValue(before, after, at - last, gap)
                                              : unmeasured;
  }
};

// --- pyramid -------------------------------------------------------------------------------------

/// Unmatched share of a level, among matchable pixels.
struct OpenShare {
  std::uint32_t nearest_bits;  // of the largest disparity, 0 if none is positive
  int matchable, unmatched;
};
struct NearestKernel {
  static constexpr int kThreads = 256, kPhases = 3, kEach = 16;
  struct Shared {
    std::uint32_t largest;
  };
  using Local = Nothing;
  const float* disparity_px;
  int count;
  OpenShare* share;

  Grid blocks() const { return {blocksFor(count, kThreads * kEach), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared.largest = 0;
    } else if constexpr (kPhase == 1) {
      float largest = 0;
      for (int k = 0; k < kEach; ++k) {
        const int i = (at.x * kEach + k) * kThreads + at.thread;
        if (i < count && disparity_px[i] > largest) largest = disparity_px[i];
      }
      // Bits of positive numbers have their order.
      if (floatAsBits(largest) > shared.largest)
        atomicGreatest(&shared.largest, floatAsBits(largest));
    } else if (at.thread == 0) {
      atomicGreatest(&share->nearest_bits, shared.largest);
    }
  }
};
struct OpenShareKernel {
  static constexpr int kThreads = 256, kPhases = 3, kEach = 16;
  struct Shared {
    int matchable, unmatched;
  };
  using Local = Nothing;
  const float* disparity_px;
  View<const std::uint8_t> gray, ignored;
  int darkest_gray;
  OpenShare* share;

  Grid blocks() const { return {blocksFor(gray.width * gray.height, kThreads * kEach), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared.matchable = shared.unmatched = 0;
    } else if constexpr (kPhase == 1) {
      const int first = static_cast<int>(bitsAsFloat(share->nearest_bits));
      int matchable = 0, unmatched = 0;
      for (int k = 0; k < kEach; ++k) {
        const int i = (at.x * kEach + k) * kThreads + at.thread;
        if (i >= gray.width * gray.height || i % gray.width < first ||
            gray.data[i] < darkest_gray || (ignored.data[i] & Ignored::kMasked) != 0)
          continue;
        ++matchable;
        unmatched += !isNumber(disparity_px[i]);
      }
      if (matchable > 0) atomicPlus(&shared.matchable, matchable);
      if (unmatched > 0) atomicPlus(&shared.unmatched, unmatched);
    } else if (at.thread == 0) {
      atomicPlus(&share->matchable, shared.matchable);
      atomicPlus(&share->unmatched, shared.unmatched);
    }
  }
};

/// Unmeasured pixels of the fine level get the disparity of the half size.
struct FillFromHalfBody {
  View<const float> half_disparity, half_sigma;
  View<float> disparity, sigma;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    if (isNumber(disparity.at(u, v))) return;
    const HalfPosition at = halfPosition(u, v);
    if (!half_disparity.contains(at.u0, at.v0)) return;
    const FourPixels four = fourOf(half_disparity, at);
    if (!isOneSurface(four)) return;
    disparity.at(u, v) = 2 * bilinear(four, at.fu, at.fv);
    sigma.at(u, v) = 2 * bilinear(fourOf(half_sigma, at), at.fu, at.fv);
  }

 private:
  SOFTSCOPE_HD static FourPixels fourOf(const View<const float>& image, const HalfPosition& at) {
    return fourPixels(image.data, image.width, image.height, at.u0, at.v0);
  }
};

}  // namespace softscope::cuda
