// cuda/frame/tissue_count.h: kernel that counts the depths of a frame, and for their medians.
#pragma once

#include <cmath>

#include "core/tolerance.h"
#include "cuda/device/kernel.h"
#include "cuda/device/rank_search.h"

namespace softscope::cuda {

/// What comes down in one piece.
struct TissueTotals {
  static constexpr int kSearches = 2;  // depths, sigmas
  std::int32_t tissue_px, measured_px, precise_px;
  RankSearch medians[kSearches];
};

struct TissueRasters {
  const float* depth_mm = nullptr;
  const float* sigma_mm = nullptr;  // null: none
  const std::uint8_t* not_tissue = nullptr;
  int pixels = 0;
};

/// One step of both searches; the first counts the pixels too. Counts of a block are collected in
/// its shared memory: most depths of a frame fall into few bins.
struct TissueCountKernel {
  static constexpr int kThreads = 256, kPhases = 3, kPixelsEach = 16;
  struct Shared {
    std::uint32_t bins[TissueTotals::kSearches][kRankBins];
    std::int32_t tissue_px, measured_px, precise_px;
  };
  using Local = Nothing;
  TissueRasters frame;
  std::uint32_t* counts;
  TissueTotals* totals;
  int step;

  Grid blocks() const { return {blocksFor(frame.pixels, kThreads * kPixelsEach), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      for (int bin = at.thread; bin < kRankBins; bin += kThreads)
        for (auto& of_search : shared.bins) of_search[bin] = 0;
      if (at.thread == 0) shared.tissue_px = shared.measured_px = shared.precise_px = 0;
    } else if constexpr (kPhase == 1) {
      const int first = at.x * kThreads * kPixelsEach + at.thread;
      for (int k = 0; k < kPixelsEach; ++k)
        if (first + k * kThreads < frame.pixels) count(first + k * kThreads, &shared);
    } else {
      for (int bin = at.thread; bin < kRankBins; bin += kThreads)
        for (int search = 0; search < TissueTotals::kSearches; ++search)
          if (shared.bins[search][bin] != 0)
            atomicPlus(&counts[search * kRankCounts + step * kRankBins + bin],
                       shared.bins[search][bin]);
      if (step > 0 || at.thread > 0) return;
      atomicPlus(&totals->tissue_px, shared.tissue_px);
      atomicPlus(&totals->measured_px, shared.measured_px);
      atomicPlus(&totals->precise_px, shared.precise_px);
    }
  }

 private:
  SOFTSCOPE_HD void count(int pixel, Shared* shared) const {
    if (frame.not_tissue[pixel] != 0) return;
    if (step == 0) atomicPlus(&shared->tissue_px, 1);
    const float depth_mm = frame.depth_mm[pixel];
    if (!std::isfinite(depth_mm)) return;
    if (step == 0) atomicPlus(&shared->measured_px, 1);
    add(depth_mm, 0, shared);
    if (frame.sigma_mm == nullptr) return;
    const float sigma_mm = frame.sigma_mm[pixel];
    add(sigma_mm, 1, shared);
    if (step == 0 && sigma_mm <= kPreciseSigmaMm) atomicPlus(&shared->precise_px, 1);
  }
  SOFTSCOPE_HD void add(float value, int search, Shared* shared) const {
    const int bin = rankBin(value, step, totals->medians[search]);
    if (bin >= 0) atomicPlus(&shared->bins[search][bin], 1u);
  }
};

}  // namespace softscope::cuda
