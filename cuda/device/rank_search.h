// cuda/device/rank_search.h: the value of some rank among many, exact, by the bits of its size.
#pragma once

#include <cmath>
#include <cstdint>

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Found in three steps, by 11, 11 and 9 bits: the bits of a positive float have its order.
constexpr int kRankSteps = 3, kRankBins = 2048;
SOFTSCOPE_HD constexpr int rankShift(int step) { return step == 0 ? 20 : step == 1 ? 9 : 0; }
struct RankSearch {
  std::uint32_t rank, bits;  // left within `bits`, which are those found so far
};
constexpr int kRankCounts = kRankSteps * kRankBins;  // of a search, zero at first

/// Bin of a value's size in a step, or -1 where it does not have the bits found so far.
SOFTSCOPE_HD inline int rankBin(float value, int step, const RankSearch& search) {
  const std::uint32_t bits = floatAsBits(std::abs(value));
  if (step == 0) return static_cast<int>(bits >> rankShift(0));
  const int found = rankShift(step - 1);
  if (bits >> found != search.bits >> found) return -1;
  const std::uint32_t mask = (1u << (found - rankShift(step))) - 1;
  return static_cast<int>(bits >> rankShift(step) & mask);
}

struct UpperMedian {
  SOFTSCOPE_HD static std::uint32_t rankOf(std::uint32_t count) { return count / 2; }
};
struct Percentile95 {
  SOFTSCOPE_HD static std::uint32_t rankOf(std::uint32_t count) {
    const unsigned long long last = count > 0 ? count - 1 : 0;
    return static_cast<std::uint32_t>(last * 95 / 100);
  }
};

/// A block per search, with counts of its own: bin of a step that contains the value of the rank.
template <class Rule>
struct PickRankKernel {
  static constexpr int kThreads = 256, kPhases = 2, kBinsEach = kRankBins / kThreads;
  struct Shared {
    std::uint32_t counts[kThreads];
  };
  using Local = Nothing;
  const std::uint32_t* counts;
  RankSearch* searches;
  int step, search_count;

  Grid blocks() const { return {search_count, 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const std::uint32_t* bins = counts + at.x * kRankCounts + step * kRankBins;
    if constexpr (kPhase == 0) {
      std::uint32_t sum = 0;
      for (int k = 0; k < kBinsEach; ++k) sum += bins[at.thread * kBinsEach + k];
      shared.counts[at.thread] = sum;
    } else {
      if (at.thread == 0) pick(bins, shared, &searches[at.x]);
    }
  }

 private:
  SOFTSCOPE_HD void pick(const std::uint32_t* bins, const Shared& shared, RankSearch* found) const {
    RankSearch search = *found;
    if (step == 0) {
      std::uint32_t count = 0;
      for (const std::uint32_t part : shared.counts) count += part;
      search = {Rule::rankOf(count), 0};
    }
    int part = 0;
    for (; part < kThreads - 1 && shared.counts[part] <= search.rank; ++part)
      search.rank -= shared.counts[part];
    int bin = part * kBinsEach;
    for (; bin < part * kBinsEach + kBinsEach - 1 && bins[bin] <= search.rank; ++bin)
      search.rank -= bins[bin];
    search.bits |= static_cast<std::uint32_t>(bin) << rankShift(step);
    *found = search;
  }
};

}  // namespace softscope::cuda
