// cuda/stereo/stereo_prior.h: kernel bodies of the disparity prior, interpolated from rows of
// support points.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/stereo/stereo_dense.h"
#include "stereo/kernels/prior_formulas.h"

namespace softscope::cuda {

/// Per view, rows of the support grid at every column of the image.
struct PriorRows {
  PriorEvidence *own, *above, *below;  // 2 x rows x width; above and below: swept from there
  int* has_points;                     // 2 x rows
  int width, rows, step;

  SOFTSCOPE_HD std::ptrdiff_t place(int view, int r, int u) const {
    return (static_cast<std::ptrdiff_t>(view) * rows + r) * width + u;
  }
  SOFTSCOPE_HD bool has(int view, int r) const { return has_points[view * rows + r] != 0; }
};

/// One block: one row of one view, interpolated between its points.
struct PriorRowKernel {
  static constexpr int kThreads = 256, kPhases = 3, kWidest = 8192, kWords = kWidest / 32;
  struct Shared {
    std::uint32_t points[kWords];  // a bit a column
    int count;
  };
  using Local = Nothing;
  SupportGrid grid;
  const float* disparity_px;
  PriorRows out;

  Grid blocks() const { return {1, grid.rows, 2}; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int view = at.z, r = at.y, words = (grid.width + 31) / 32;
    PriorEvidence* row = out.own + out.place(view, r, 0);
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < words; i += kThreads) shared.points[i] = 0;
      for (int u = at.thread; u < grid.width; u += kThreads) row[u] = {kNoSupport, 0, 0};
      if (at.thread == 0) shared.count = 0;
    } else if constexpr (kPhase == 1) {
      for (int c = at.thread; c < grid.columns; c += kThreads) {
        const float d = disparity_px[r * grid.columns + c];
        if (d == kNoSupport) continue;
        const int u = view == 0 ? c * grid.step : columnFromRight(c * grid.step, d);
        if (u < 0) continue;
        // Of several on one pixel the larger: positive numbers have the order of their bits.
        atomicGreatest(reinterpret_cast<int*>(&row[u].disparity_px),
                       static_cast<int>(floatAsBits(d)));
        atomicUnite(&shared.points[u / 32], std::uint32_t{1} << (u % 32));
        atomicGreatest(&shared.count, 1);
      }
    } else {
      if (at.thread == 0) out.has_points[view * grid.rows + r] = shared.count;
      if (shared.count == 0) return;
      for (int u = at.thread; u < grid.width; u += kThreads) {
        if ((shared.points[u / 32] >> (u % 32) & 1) != 0) continue;
        const int last = lastPoint(shared, u), next = nextPoint(shared, u, words);
        const float from = last >= 0 ? row[last].disparity_px : 0,
                    to = next < grid.width ? row[next].disparity_px : 0;
        row[u] = priorBetween(u, last, next, grid.width, from, to);
      }
    }
  }

 private:
  /// -1: none.
  SOFTSCOPE_HD static int lastPoint(const Shared& shared, int u) {
    int word = u / 32;
    std::uint32_t bits = shared.points[word] & ((std::uint32_t{1} << (u % 32)) - 1);
    while (bits == 0 && word > 0) bits = shared.points[--word];
    return bits == 0 ? -1 : 32 * word + highestBit(bits);
  }
  /// The width means none.
  SOFTSCOPE_HD int nextPoint(const Shared& shared, int u, int words) const {
    int word = u / 32;
    std::uint32_t bits = shared.points[word] & ~((std::uint32_t{2} << (u % 32)) - 1);
    while (bits == 0 && word + 1 < words) bits = shared.points[++word];
    return bits == 0 ? grid.width : 32 * word + highestBit(bits & (~bits + 1));
  }
};

/// One thread: one column of one view, from above or from below;
/// each row inherits from the previous row if its points are nearer.
struct PriorSweepKernel {
  static constexpr int kThreads = 32, kPhases = 1, kAhead = 12;
  using Shared = Nothing;
  using Local = Nothing;
  PriorRows rows;

  Grid blocks() const { return {blocksFor(rows.width, kThreads), 2, 2}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int u = at.x * kThreads + at.thread, view = at.z;
    if (u >= rows.width) return;
    PriorEvidence* out = at.y == 0 ? rows.above : rows.below;
    PriorEvidence before{};
    int before_row = -1;
    for (int k = 0; k < rows.rows; k += kAhead) {
      PriorEvidence own[kAhead];  // fetched together to hide latency
      for (int j = 0; j < kAhead; ++j)
        if (k + j < rows.rows) own[j] = rows.own[rows.place(view, rowOf(at.y, k + j), u)];
      for (int j = 0; j < kAhead; ++j) {
        if (k + j >= rows.rows) break;
        const int r = rowOf(at.y, k + j);
        PriorEvidence here = own[j];
        if (here.disparity_px == kNoSupport) continue;  // a row without points
        if (before_row >= 0) {
          const int apart = r > before_row ? r - before_row : before_row - r;
          here = nearerEvidence(here, before, static_cast<float>(apart * rows.step));
        }
        out[rows.place(view, r, u)] = here;
        before = here;
        before_row = r;
      }
    }
  }

 private:
  SOFTSCOPE_HD int rowOf(int direction, int k) const {
    return direction == 0 ? k : rows.rows - 1 - k;
  }
};

struct PriorBody {
  static constexpr std::int16_t kNoPrior = INT16_MIN;
  PriorRows rows;
  View<std::int16_t> prior[2];  // 1/8 px

  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    int above = v / rows.step, below = above + 1;
    while (above >= 0 && !rows.has(view, above)) --above;
    while (below < rows.rows && !rows.has(view, below)) ++below;
    std::int16_t found = kNoPrior;
    if (above >= 0 && below < rows.rows) {
      found = inEighths(priorBetweenRows(
          rows.above[rows.place(view, above, u)], rows.below[rows.place(view, below, u)],
          static_cast<float>(v - above * rows.step), static_cast<float>(below * rows.step - v)));
    } else if (above >= 0) {
      found = inEighths(rows.above[rows.place(view, above, u)].disparity_px);
    } else if (below < rows.rows) {
      found = inEighths(rows.below[rows.place(view, below, u)].disparity_px);
    }
    prior[view].at(u, v) = found;
  }
};

}  // namespace softscope::cuda
