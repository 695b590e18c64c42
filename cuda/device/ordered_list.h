// cuda/device/ordered_list.h: kernel bodies that give chosen elements of a sequence consecutive
// places, in their order.
//
// An Each has
//   int capacity() const;                   // of the launch: count() is at most this
//   SOFTSCOPE_HD int count() const;         // of the sequence
//   SOFTSCOPE_HD bool chosen(int i) const;
//   SOFTSCOPE_HD void put(int i, int place) const;
#pragma once

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Elements of one block.
constexpr int kListThreads = 256, kListEach = 4, kListBlock = kListThreads * kListEach;

/// How many elements of each block are chosen.
template <class Each>
struct CountChosenKernel {
  static constexpr int kThreads = kListThreads, kPhases = 3;
  struct Shared {
    int chosen;
  };
  using Local = Nothing;
  Each each;
  int* counts;  // per block

  Grid blocks() const { return {blocksFor(each.capacity(), kListBlock), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared.chosen = 0;
    } else if constexpr (kPhase == 1) {
      const int first = at.x * kListBlock + at.thread * kListEach;
      int own = 0;
      for (int i = first; i < first + kListEach && i < each.count(); ++i) own += each.chosen(i);
      if (own > 0) atomicPlus(&shared.chosen, own);
    } else {
      if (at.thread == 0) counts[at.x] = shared.chosen;
    }
  }
};

/// After CountChosenKernel, one block: turns counts into places of each block's first, and finds
/// their sum.
struct ListStartsKernel {
  static constexpr int kThreads = 1024, kPhases = 3, kParts = 32, kPart = kThreads / kParts;
  struct Shared {
    int sums[kThreads + kParts];  // a gap after each part, against bank conflicts
    int parts[kParts];
  };
  using Local = Nothing;
  int* counts;
  int count;  // of blocks
  int* total;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int each = (count + kThreads - 1) / kThreads;
    const int begin = at.thread * each, end = begin + each < count ? begin + each : count;
    if constexpr (kPhase == 0) {
      int sum = 0;
      for (int k = begin; k < end; ++k) sum += counts[k];
      shared.sums[padded(at.thread)] = sum;
    } else if constexpr (kPhase == 1) {
      if (at.thread >= kParts) return;
      int sum = 0;
      for (int k = at.thread * kPart; k < (at.thread + 1) * kPart; ++k) {
        const int own = shared.sums[padded(k)];
        shared.sums[padded(k)] = sum;
        sum += own;
      }
      shared.parts[at.thread] = sum;
    } else {
      const int part = at.thread / kPart;
      int place = shared.sums[padded(at.thread)];
      for (int k = 0; k < part; ++k) place += shared.parts[k];
      for (int k = begin; k < end; ++k) {
        const int own = counts[k];
        counts[k] = place;
        place += own;
      }
      if (at.thread == kThreads - 1) *total = place;
    }
  }

 private:
  SOFTSCOPE_HD static int padded(int k) { return k + k / kPart; }
};

/// After ListStartsKernel: each.put() of every chosen element.
template <class Each>
struct PutChosenKernel {
  static constexpr int kThreads = kListThreads, kPhases = 3, kParts = 16, kPart = kThreads / kParts;
  struct Shared {
    int sums[kThreads + kParts];
    int parts[kParts];
  };
  using Local = Nothing;
  Each each;
  const int* starts;  // per block

  Grid blocks() const { return {blocksFor(each.capacity(), kListBlock), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int first = at.x * kListBlock + at.thread * kListEach;
    if constexpr (kPhase == 0) {
      int own = 0;
      for (int i = first; i < first + kListEach && i < each.count(); ++i) own += each.chosen(i);
      shared.sums[padded(at.thread)] = own;
    } else if constexpr (kPhase == 1) {
      if (at.thread >= kParts) return;
      int sum = 0;
      for (int k = at.thread * kPart; k < (at.thread + 1) * kPart; ++k) {
        const int own = shared.sums[padded(k)];
        shared.sums[padded(k)] = sum;
        sum += own;
      }
      shared.parts[at.thread] = sum;
    } else {
      int place = starts[at.x] + shared.sums[padded(at.thread)];
      for (int k = 0; k < at.thread / kPart; ++k) place += shared.parts[k];
      for (int i = first; i < first + kListEach && i < each.count(); ++i)
        if (each.chosen(i)) each.put(i, place++);
    }
  }

 private:
  SOFTSCOPE_HD static int padded(int k) { return k + k / kPart; }
};

/// All of it; `counts` has room for a number per block. Where chosen() must stay as it is while
/// put() runs, that is the caller's care.
template <class Executor, class Each>
void putInOrder(Executor& executor, const Each& each, int* counts, int* total) {
  const CountChosenKernel<Each> count{each, counts};
  executor.launch("count chosen", count, count.blocks());
  executor.launch("list starts", ListStartsKernel{counts, count.blocks().x, total}, Grid{});
  const PutChosenKernel<Each> put{each, counts};
  executor.launch("put chosen", put, put.blocks());
}

}  // namespace softscope::cuda
