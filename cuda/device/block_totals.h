// cuda/device/block_totals.h: sums over a block without a place that all its threads compete for.
#pragma once

#include "cuda/device/fixed_sum.h"
#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Sums of kCount numbers per thread over a block, added to others. kSteps phases, the first of
/// which takes what a thread has.
template <int kThreads, int kCount>
struct BlockTotals {
  static constexpr int kSteps = 3, kLanes = 32;
  struct Shared {
    FixedSum own[kCount][kThreads], lanes[kCount][kLanes];
  };

  SOFTSCOPE_HD static void take(int thread, const FixedSum (&own)[kCount], Shared& shared) {
    for (int i = 0; i < kCount; ++i) shared.own[i][thread] = own[i];
  }
  SOFTSCOPE_HD static void addLane(int thread, Shared& shared) {
    if (thread >= kCount * kLanes) return;
    FixedSum sum = 0;
    for (int k = thread % kLanes; k < kThreads; k += kLanes) sum += shared.own[thread / kLanes][k];
    shared.lanes[thread / kLanes][thread % kLanes] = sum;
  }
  /// For threads below kCount.
  SOFTSCOPE_HD static void addTo(FixedSum* total, int thread, const Shared& shared) {
    FixedSum sum = 0;
    for (const FixedSum lane : shared.lanes[thread]) sum += lane;
    if (sum != 0) atomicPlus(total, sum);
  }
};

}  // namespace softscope::cuda
