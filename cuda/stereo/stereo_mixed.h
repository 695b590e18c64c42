// cuda/stereo/stereo_mixed.h: kernel bodies for refinement windows with mixed surfaces.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/stereo/stereo_refinement.h"

namespace softscope::cuda {

/// Marks both ends of every step along rows and columns. `marks` are initially 0.
struct MarkStepsBody {
  View<const float> disparity;
  View<std::uint8_t> marks;
  int widest;
  float step, slope;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const float here = disparity.at(u, v);
    if (!isNumber(here)) return;
    for (int apart = 1; apart <= widest && u - apart >= 0; ++apart) {
      const float before = disparity.at(u - apart, v);
      if (!isNumber(before)) continue;
      if (isDepthStep(here, before, apart, step, slope))
        marks.at(u, v) = marks.at(u - apart, v) = 1;
      break;
    }
    for (int apart = 1; apart <= widest && v - apart >= 0; ++apart) {
      const float before = disparity.at(u, v - apart);
      if (!isNumber(before)) continue;
      if (isDepthStep(here, before, apart, step, slope))
        marks.at(u, v) = marks.at(u, v - apart) = 1;
      break;
    }
  }
};

/// Per pixel with a disparity, whether its window contains another surface.
struct Selection {
  float weights[kWidestWindow * kSelectLanes], tolerance[kWidestWindow * kSelectLanes];
};
/// Stores it such that lanes can read different positions at the same time.
struct StoreSelectionKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  static_assert(kThreads >= kWidestWindow * kSelectLanes, "a thread a place");
  using Shared = Nothing;
  using Local = Nothing;
  Selection selection;
  Selection* out;
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    if (at.thread >= kWidestWindow * kSelectLanes) return;
    out->weights[at.thread] = selection.weights[at.thread];
    out->tolerance[at.thread] = selection.tolerance[at.thread];
  }
};
/// One block: 32 x 16 pixels.
struct MarkMixedKernel {
  static constexpr int kThreads = 256, kPhases = 2, kWidth = 32, kHeight = 16;
  static constexpr int kReach = RefinementOptions::kLargestRadiusPx;
  static constexpr int kColumns = kWidth + 2 * kReach, kRows = kHeight + 2 * kReach;
  struct Shared {
    float disparity[kRows][kColumns];
    std::uint8_t near_marks[kRows][kWidth];
  };
  using Local = Nothing;
  View<const float> disparity;
  View<const std::uint8_t> near_marks;  // spread along rows
  View<std::uint8_t> mixed;
  int* list;
  int* list_count;
  int radius;
  Selection selection;

  Grid blocks() const {
    return {blocksFor(mixed.width, kWidth), blocksFor(mixed.height, kHeight), 1};
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int u0 = at.x * kWidth, v0 = at.y * kHeight;
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < kColumns * kRows; i += kThreads) {
        const int x = i % kColumns, y = i / kColumns, u = u0 - kReach + x, v = v0 - kReach + y;
        shared.disparity[y][x] = disparity.contains(u, v) ? disparity.at(u, v) : quietNan();
      }
      for (int i = at.thread; i < kWidth * kRows; i += kThreads) {
        const int u = u0 + i % kWidth, v = v0 - kReach + i / kWidth;
        shared.near_marks[i / kWidth][i % kWidth] =
            near_marks.contains(u, v) ? near_marks.at(u, v) : std::uint8_t{0};
      }
    } else {
      for (int i = at.thread; i < kWidth * kHeight; i += kThreads) {
        const int x = i % kWidth, y = i / kWidth, u = u0 + x, v = v0 + y;
        if (!mixed.contains(u, v)) continue;
        const bool found = isMixed(x, y, shared);
        mixed.at(u, v) = found;
        if (found) list[atomicPlus(list_count, 1)] = v * mixed.width + u;
      }
    }
  }

 private:
  SOFTSCOPE_HD bool isMixed(int x, int y, const Shared& shared) const {
    const float centre = shared.disparity[y + kReach][x + kReach];
    std::uint8_t near = 0;
    for (int dy = -radius; dy <= radius; ++dy) near |= shared.near_marks[y + kReach + dy][x];
    if (!isNumber(centre) || near == 0) return false;
    bool found = false;
    for (int dy = -radius; dy <= radius && !found; ++dy)
      for (int dx = -radius; dx <= radius; ++dx)
        found |= absoluteOf(shared.disparity[y + kReach + dy][x + kReach + dx] - centre) >
                 selection.tolerance[(dy + radius) * kSelectLanes + dx + radius];
    return found;
  }
};

/// Windows with mixed surfaces: pixels of the surface of the centre, 16 lanes per pixel.
template <bool kLast>
struct MixedStepKernel {
  static constexpr int kThreads = 256, kPhases = 3, kPixels = kThreads / kSelectLanes;
  static constexpr int kSums = kLast ? 13 : 9, kBlocks = 528;
  struct Shared {
    float parts[kPixels][kSums][kSelectLanes + 1], sums[kPixels][kSums];
  };
  using Local = Nothing;
  ResidualPlanes in;
  const int* list;
  const int* list_count;
  StepSolver solver;
  const Selection* selection;
  int radius;

  Grid blocks() const { return {kBlocks, 1, 1}; }
  SOFTSCOPE_HD int repeats(const Place& at) const {
    const int groups = (*list_count + kPixels - 1) / kPixels;
    return (groups - at.x + at.grid.x - 1) / at.grid.x;
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int pixel = at.thread / kSelectLanes, lane = at.thread % kSelectLanes;
    const int entry = (at.x + at.repeat * at.grid.x) * kPixels + pixel;
    if (entry >= *list_count) return;
    const int width = solver.before.width, u = list[entry] % width, v = list[entry] / width;
    if (!isNumber(solver.before.at(u, v))) return;
    if constexpr (kPhase == 0) {
      sumColumn(u, v, lane, shared.parts[pixel]);
    } else if constexpr (kPhase == 1) {
      if (lane < kSums) shared.sums[pixel][lane] = sumLanesOf(shared.parts[pixel][lane], 1);
    } else if (lane == 0) {
      float moments[9], evidence[4] = {0, 0, 0, 0};
      for (int k = 0; k < 9; ++k) moments[k] = shared.sums[pixel][k];
      for (int k = 9; k < kSums; ++k) evidence[k - 9] = shared.sums[pixel][k];
      solver.solve<kLast>(u, v, moments, evidence);
    }
  }

 private:
  SOFTSCOPE_HD void sumColumn(int u, int v, int lane,
                              float (&parts)[kSums][kSelectLanes + 1]) const {
    const float centre = solver.before.at(u, v);
    const int column = u - radius + lane;
    float g0 = 0, g1 = 0, g2 = 0, q0 = 0, q1 = 0, evidence[4] = {0, 0, 0, 0};
    const bool inside = lane <= 2 * radius && column >= 0 && column < solver.before.width;
    for (int y = 0; inside && y <= 2 * radius; ++y) {
      const int row = v - radius + y;
      if (row < 0 || row >= solver.before.height) continue;
      const int k = y * kSelectLanes + lane;
      const float apart = absoluteOf(solver.before.at(column, row) - centre);
      const float w = apart <= selection->tolerance[k] ? selection->weights[k] : 0.0f;
      const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(row) * solver.before.width + column;
      const float fy = static_cast<float>(y - radius);
      const float g = w * in.planes[0][place], q = w * in.planes[1][place];
      g0 += g;
      g1 += fy * g;
      g2 += fy * fy * g;
      q0 += q;
      q1 += fy * q;
      if constexpr (kLast)
        for (int m = 0; m < 4; ++m) evidence[m] += w * in.planes[2 + m][place];
    }
    const float x = static_cast<float>(lane - radius);
    const float planes[9] = {g0, x * g0, g1, x * x * g0, x * g1, g2, q0, x * q0, q1};
    for (int m = 0; m < 9; ++m) parts[m][lane] = planes[m];
    if constexpr (kLast)
      for (int m = 0; m < 4; ++m) parts[9 + m][lane] = evidence[m];
  }
};

}  // namespace softscope::cuda
