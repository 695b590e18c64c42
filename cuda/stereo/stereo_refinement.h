// cuda/stereo/stereo_refinement.h: kernel bodies of sub-pixel refinement.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "stereo/kernels/filter_formulas.h"
#include "stereo/kernels/refinement_formulas.h"
#include "stereo/kernels/relief_formulas.h"
#include "stereo/refinement/refinement_window.h"

namespace softscope::cuda {

constexpr int kWidestWindow = 2 * RefinementOptions::kLargestRadiusPx + 1;

/// Weights of the low-pass part of the brightness, as kernel argument.
struct SlowWeights {
  static constexpr int kMost = 129;
  float values[kMost];
  int reach;
};

// --- brightness in two parts, and light
// --------------------------------------------------------------

struct BrightnessRowBody {
  View<const std::uint8_t> gray[2];
  View<float> slow[2], smooth[2];
  SlowWeights weights;

  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    const std::uint8_t* row = gray[view].row(v);
    const int last = gray[view].width - 1;
    const auto pixel = [&](int x) {
      return static_cast<float>(row[x < 0 ? 0 : (x > last ? last : x)]);
    };
    float slow_sum = 0, smooth_sum = 0;
    for (int t = -weights.reach; t <= weights.reach; ++t)
      slow_sum += weights.values[t + weights.reach] * pixel(u + t);
    const float binomial[3] = {0.25f, 0.5f, 0.25f};
    for (int t = -1; t <= 1; ++t) smooth_sum += binomial[t + 1] * pixel(u + t);
    slow[view].at(u, v) = slow_sum;
    smooth[view].at(u, v) = smooth_sum;
  }
};
struct BrightnessColumnBody {
  View<const float> slow[2], smooth[2];
  View<float> fast_part[2], slow_part[2];
  SlowWeights weights;

  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    const int last = fast_part[view].height - 1;
    const auto row = [&](int y) { return y < 0 ? 0 : (y > last ? last : y); };
    const float binomial[3] = {0.25f, 0.5f, 0.25f};
    float slow_sum = 0, fast_sum = 0;
    for (int y = -weights.reach; y <= weights.reach; ++y)
      slow_sum += weights.values[y + weights.reach] * slow[view].at(u, row(v + y));
    for (int y = -1; y <= 1; ++y) fast_sum += binomial[y + 1] * smooth[view].at(u, row(v + y));
    slow_part[view].at(u, v) = slow_sum;
    fast_part[view].at(u, v) = fast_sum - slow_sum;
  }
};

/// One block fits the brightness difference of the cameras, in rounds.
struct LightFitKernel {
  static constexpr int kThreads = 512, kPhases = 4;
  struct Shared {
    LightSums total;
  };
  using Local = Nothing;
  View<const float> slow_left, slow_right, disparity;
  LightSums* parts;  // kParts a row of samples; the first then holds the row
  LightDifference* light;
  int step;

  Grid blocks() const { return {1, 1, 1}; }
  SOFTSCOPE_HD int repeats(const Place&) const { return LightFit::rounds(step); }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    constexpr int kParts = LightFit::kParts, kNormal = triangleSize(LightDifference::kTerms);
    const int rows = LightFit::samplesAlong(disparity.height);
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < rows * kParts; i += kThreads) {
        const int v = LightFit::place(i / kParts);
        parts[i] = lightSumsOfPart(slow_left.row(v), slow_right.row(v), disparity.row(v), v,
                                   i % kParts, disparity.width, disparity.height, *light,
                                   LightFit::tolerance(step, at.repeat));
      }
    } else if constexpr (kPhase == 1) {
      for (int row = at.thread; row < rows; row += kThreads) {
        LightSums sums;
        for (int part = 0; part < kParts; ++part) sums.add(parts[row * kParts + part]);
        parts[row * kParts] = sums;
      }
    } else if constexpr (kPhase == 2) {
      if (at.thread >= kNormal + LightDifference::kTerms) return;
      const bool normal = at.thread < kNormal;
      const int term = normal ? at.thread : at.thread - kNormal;
      double sum = 0;
      for (int row = 0; row < rows; ++row) {
        const LightSums& sums = parts[row * kParts];
        sum += normal ? sums.normal[term] : sums.right[term];
      }
      (normal ? shared.total.normal[term] : shared.total.right[term]) = sum;
    } else {
      if (at.thread == 0) *light = solveLight(shared.total);
    }
  }
};

// --- a step
// ----------------------------------------------------------------------------------------

/// Planes of ResidualRow; the last four in the last step alone.
constexpr int kResidualPlanes = 6;
struct ResidualPlanes {
  float* planes[kResidualPlanes];
};

template <bool kLast>
struct ResidualBody {
  View<const float> left, right, slow_left, slow_right, disparity;
  const LightDifference* light;
  ResidualPlanes out;
  ResidualLimits limits;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const float given = disparity.at(u, v), d = isNumber(given) ? given : 0.0f;
    const int last = right.width - 1;
    float x = static_cast<float>(u) - given;  // comparisons with NaN are false
    const float inside = x >= 0.0f && x <= static_cast<float>(last) ? 1.0f : 0.0f;
    x = x >= 0.0f ? x : 0.0f;
    x = x <= static_cast<float>(last) ? x : static_cast<float>(last);
    const int i = static_cast<int>(x);
    const float t = x - static_cast<float>(i);
    const auto valueAt = [&](const float* row) {
      return catmullRom(row[i > 0 ? i - 1 : 0], row[i], row[i < last ? i + 1 : last],
                        row[i + 2 < last ? i + 2 : last], t);
    };
    const float slow = slow_left.at(u, v);
    const float light_here =
        lightAt(lightOfRow(*light, v, right.width, right.height), static_cast<float>(u), slow);
    const PixelResidual<float> pixel = pixelResidual(
        left.at(u, v), valueAt(right.row(v)),
        agreedSlowPart(valueAt(slow_right.row(v)), slow, light_here, limits.light_gray_sq), inside,
        d, limits);
    const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(v) * right.width + u;
    out.planes[0][place] = pixel.information;
    out.planes[1][place] = pixel.target;
    if constexpr (kLast) {
      out.planes[2][place] = pixel.residual_sq;
      out.planes[3][place] = pixel.weight;
      out.planes[4][place] = pixel.difference_sq;
      out.planes[5][place] = pixel.energy;
    }
  }
};

/// Next disparity from the sums of a window.
struct StepSolver {
  PlaneLimits limits;
  RefinementStep rules;
  View<const float> before;
  View<float> next, sigma, response;
  View<float> beside, below;  // EvidenceCentre; without memory if it is not wanted

  template <bool kLast>
  SOFTSCOPE_HD void solve(int u, int v, const float (&moments)[9],
                          const float (&evidence)[4]) const {
    float disparity = planeDisparity(moments, before.at(u, v), rules.of_disparity,
                                     limits.farthest_step_px, rules.relaxation, quietNan());
    if constexpr (kLast) {
      bool holds;
      const float variance =
          planeVariance(moments, evidence, disparity, limits.prior_weight, limits.noise_floor_sq,
                        limits.independent_pixels, limits.model_variance_px2,
                        limits.max_variance_px2, limits.max_difference, &holds);
      disparity = holds ? disparity : quietNan();
      sigma.at(u, v) = holds ? std::sqrt(variance) : quietNan();
      const float noise_sq = noiseOfWindow(evidence, limits.noise_floor_sq);
      response.at(u, v) =
          reliefResponse(evidenceShare(moments[0], evidence[1], noise_sq, limits.prior_weight));
      if (beside.data != nullptr) {
        const EvidenceCentre<float> centre =
            evidenceCentre(moments, evidence, limits.prior_weight, limits.noise_floor_sq);
        beside.at(u, v) = centre.x;
        below.at(u, v) = centre.y;
      }
    }
    next.at(u, v) = disparity;
  }
};

/// Treatment of windows with mixed surfaces.
enum class MixedWindows { kHold, kLeave };

/// One block: 32 x 16 pixels.
template <bool kLast>
struct WindowStepKernel {
  static constexpr int kThreads = 256, kWidth = 32, kHeight = 16;
  static constexpr int kPhases = kLast ? 7 : 3;
  static constexpr int kReach = RefinementOptions::radius_px;
  static constexpr int kColumns = kWidth + 2 * kReach, kRows = kHeight + 2 * kReach;
  static constexpr int kPixelsOfThread = kWidth * kHeight / kThreads;
  struct Shared {
    float planes[2][kRows][kColumns];
    float columns[5][kHeight][kColumns];
  };
  struct Local {
    float moments[kPixelsOfThread][9], evidence[kPixelsOfThread][4];
  };
  ResidualPlanes in;
  View<const std::uint8_t> mixed;
  StepSolver solver;
  MixedWindows mixed_windows;
  float window[kWidestWindow];

  Grid blocks() const {
    return {blocksFor(mixed.width, kWidth), blocksFor(mixed.height, kHeight), 1};
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    if constexpr (kPhase == 0) {
      load(at, 0, shared);
    } else if constexpr (kPhase == 1) {
      sumColumns(at, shared);
    } else if constexpr (kPhase == 2) {
      for (int k = 0; k < kPixelsOfThread; ++k)
        windowMomentsOf([&](int moment, int x) { return columnOf(shared, moment, at, k)[x]; },
                        window, kReach, local.moments[k]);
      if constexpr (kLast)
        load(at, 2, shared);
      else
        solve(at, local);
    } else if constexpr (kPhase == 3 || kPhase == 5) {
      sumEvidenceColumns(at, shared);
    } else {
      constexpr int kFirst = kPhase == 4 ? 0 : 2;
      for (int k = 0; k < kPixelsOfThread; ++k)
        for (int plane = 0; plane < 2; ++plane) {
          const float* column = columnOf(shared, plane, at, k);
          float sum = 0;
          for (int x = -kReach; x <= kReach; ++x) sum += window[x + kReach] * column[x];
          local.evidence[k][kFirst + plane] = sum;
        }
      if constexpr (kPhase == 4)
        load(at, 4, shared);
      else
        solve(at, local);
    }
  }

 private:
  SOFTSCOPE_HD void load(const Place& at, int first, Shared& shared) const {
    const int columns = kWidth + 2 * kReach, rows = kHeight + 2 * kReach;
    const int u0 = at.x * kWidth - kReach, v0 = at.y * kHeight - kReach;
    for (int i = at.thread; i < columns * rows; i += kThreads) {
      const int x = i % columns, y = i / columns, u = u0 + x, v = v0 + y;
      const bool inside = mixed.contains(u, v);
      const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(v) * mixed.width + u;
      shared.planes[0][y][x] = inside ? in.planes[first][place] : 0.0f;
      shared.planes[1][y][x] = inside ? in.planes[first + 1][place] : 0.0f;
    }
  }
  SOFTSCOPE_HD void sumColumns(const Place& at, Shared& shared) const {
    const int columns = kWidth + 2 * kReach;
    for (int i = at.thread; i < columns * kHeight; i += kThreads) {
      const int x = i % columns, row = i / columns;
      float sums[5];
      columnMomentsOf([&](int y) { return shared.planes[0][row + kReach + y][x]; },
                      [&](int y) { return shared.planes[1][row + kReach + y][x]; }, window, kReach,
                      sums);
      for (int k = 0; k < 5; ++k) shared.columns[k][row][x] = sums[k];
    }
  }
  SOFTSCOPE_HD void sumEvidenceColumns(const Place& at, Shared& shared) const {
    const int columns = kWidth + 2 * kReach;
    for (int i = at.thread; i < columns * kHeight; i += kThreads) {
      const int x = i % columns, row = i / columns;
      for (int plane = 0; plane < 2; ++plane) {
        float sum = 0;
        for (int y = 0; y <= 2 * kReach; ++y) sum += window[y] * shared.planes[plane][row + y][x];
        shared.columns[plane][row][x] = sum;
      }
    }
  }
  /// Row and column of a thread's k-th pixel in its block.
  SOFTSCOPE_HD static int columnInBlock(const Place& at) { return at.thread % kWidth; }
  SOFTSCOPE_HD static int rowInBlock(const Place& at, int k) {
    return at.thread / kWidth + k * (kThreads / kWidth);
  }
  SOFTSCOPE_HD const float* columnOf(const Shared& shared, int moment, const Place& at,
                                     int k) const {
    return &shared.columns[moment][rowInBlock(at, k)][columnInBlock(at) + kReach];
  }
  SOFTSCOPE_HD void solve(const Place& at, const Local& local) const {
    for (int k = 0; k < kPixelsOfThread; ++k) {
      const int u = at.x * kWidth + columnInBlock(at), v = at.y * kHeight + rowInBlock(at, k);
      if (!mixed.contains(u, v)) continue;
      if (mixed.at(u, v) == 0)
        solver.solve<kLast>(u, v, local.moments[k], local.evidence[k]);
      else if (mixed_windows == MixedWindows::kHold)
        solver.next.at(u, v) = solver.before.at(u, v);
      else if (!isNumber(solver.before.at(u, v)))  // removed from the list
        forget(u, v);
    }
  }
  SOFTSCOPE_HD void forget(int u, int v) const {
    solver.next.at(u, v) = quietNan();
    if constexpr (kLast) solver.sigma.at(u, v) = quietNan();
  }
};

// --- rims
// ---------------------------------------------------------------------------------

struct MarkBeyondEvidenceBody {
  View<const float> disparity, beside, below, fast, slow;
  View<std::uint8_t> beyond;
  float rim_px;
  int reach;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const auto isMeasured = [&](int x, int y) {
      return disparity.contains(u + x, v + y) && isNumber(disparity.at(u + x, v + y));
    };
    const auto grayAt = [&](int x, int y) {
      const int column = clamped(u + x, fast.width - 1), row = clamped(v + y, fast.height - 1);
      return fast.at(column, row) + slow.at(column, row);
    };
    beyond.at(u, v) = isMeasured(0, 0) && isBeyondEvidence(beside.at(u, v), below.at(u, v), rim_px,
                                                           reach, isMeasured, grayAt);
  }

 private:
  SOFTSCOPE_HD static int clamped(int i, int last) { return i < 0 ? 0 : (i > last ? last : i); }
};
struct MarkUnevenBody {
  View<const float> disparity;
  View<std::uint8_t> uneven;
  int radius;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const float centre = disparity.at(u, v);
    int measured = 0, apart = 0;
    for (int y = v - radius; y <= v + radius; y += kUnevenSpacingPx)
      for (int x = u - radius; x <= u + radius; x += kUnevenSpacingPx) {
        if (!disparity.contains(x, y)) continue;
        measured += isNumber(disparity.at(x, y));
        apart += isApart(disparity.at(x, y), centre);
      }
    uneven.at(u, v) = isUneven(apart, measured);
  }
};
struct DropMarkedBody {
  View<const std::uint8_t> marks;
  View<float> disparity, sigma;
  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    if (marks.at(u, v) != 0) disparity.at(u, v) = sigma.at(u, v) = quietNan();
  }
};

}  // namespace softscope::cuda
