// cuda/device/block_median.h: median of a few thousand positive numbers by one block, in phases.
#pragma once

#include <cstdint>
#include <cstring>

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Radix selection: three digits of 11 bits, then the least key with these digits: the upper
/// median, to 2^-21 of its value. A thread holds kEach keys; bits of positive doubles have their
/// order.
template <int kThreads, int kEach>
struct BlockMedian {
  static constexpr int kDigitBits = 11, kDigits = 3, kBins = 1 << kDigitBits;
  static constexpr int kParts = 4;                     // of a digit: phases, in order
  static constexpr int kSteps = kParts * kDigits + 2;  // all phases
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

  static constexpr int kGroup = 16;  // threads
  static_assert(kThreads % kGroup == 0);

  struct Shared {
    int bins[kBins];
    int parts[kThreads], groups[kThreads / kGroup];
    std::uint64_t prefix[kDigits + 1];
    int rank[kDigits + 1];
    int count;  // of keys
    unsigned long long least;

    /// After the last step, with at least one key.
    SOFTSCOPE_HD double value() const {
      double value;
      const unsigned long long bits = least;
      memcpy(&value, &bits, sizeof value);
      return value;
    }
  };

  SOFTSCOPE_HD static std::uint64_t keyOf(double value) {
    std::uint64_t key;
    memcpy(&key, &value, sizeof key);
    return key;
  }

  template <int kStep>
  SOFTSCOPE_HD static void run(int thread, const std::uint64_t (&keys)[kEach], Shared& shared) {
    if constexpr (kStep == 0) {
      clear(thread, shared);
      if (thread == 0) shared.count = 0;
      if (thread == 0) shared.least = kNoKey;
    } else if constexpr (kStep == kSteps - 1) {
      for (const std::uint64_t key : keys)
        if (key != kNoKey && key >> shift(kDigits - 1) == shared.prefix[kDigits])
          atomicLeast(&shared.least, static_cast<unsigned long long>(key));
    } else {
      constexpr int kDigit = (kStep - 1) / kParts, kPart = (kStep - 1) % kParts;
      if constexpr (kPart == 0)
        count<kDigit>(keys, shared);
      else if constexpr (kPart == 1)
        sum(thread, shared);
      else if constexpr (kPart == 2)
        sumGroup(thread, shared);
      else
        select<kDigit>(thread, shared);
    }
  }

 private:
  static constexpr int kBinsEach = kBins / kThreads;
  SOFTSCOPE_HD static constexpr int shift(int digit) { return 64 - (digit + 1) * kDigitBits; }

  SOFTSCOPE_HD static void clear(int thread, Shared& shared) {
    for (int k = 0; k < kBinsEach; ++k) shared.bins[thread * kBinsEach + k] = 0;
  }
  template <int kDigit>
  SOFTSCOPE_HD static void count(const std::uint64_t (&keys)[kEach], Shared& shared) {
    int own = 0;
    for (const std::uint64_t key : keys) {
      if (key == kNoKey) continue;
      ++own;
      if constexpr (kDigit > 0)
        if (key >> shift(kDigit - 1) != shared.prefix[kDigit]) continue;
      atomicPlus(&shared.bins[key >> shift(kDigit) & (kBins - 1)], 1);
    }
    if constexpr (kDigit == 0)
      if (own > 0) atomicPlus(&shared.count, own);
  }
  SOFTSCOPE_HD static void sum(int thread, Shared& shared) {
    int total = 0;
    for (int k = 0; k < kBinsEach; ++k) total += shared.bins[thread * kBinsEach + k];
    shared.parts[thread] = total;
  }
  SOFTSCOPE_HD static void sumGroup(int thread, Shared& shared) {
    if (thread >= kThreads / kGroup) return;
    int total = 0;
    for (int k = 0; k < kGroup; ++k) total += shared.parts[thread * kGroup + k];
    shared.groups[thread] = total;
  }
  template <int kDigit>
  SOFTSCOPE_HD static void select(int thread, Shared& shared) {
    const int rank = kDigit == 0 ? shared.count / 2 : shared.rank[kDigit];
    int below = 0;
    for (int group = 0; group < thread / kGroup; ++group) below += shared.groups[group];
    for (int k = thread / kGroup * kGroup; k < thread; ++k) below += shared.parts[k];
    if (below <= rank && rank < below + shared.parts[thread]) {
      int bin = thread * kBinsEach;
      while (below + shared.bins[bin] <= rank) below += shared.bins[bin++];
      shared.rank[kDigit + 1] = rank - below;
      const std::uint64_t before = kDigit == 0 ? 0 : shared.prefix[kDigit];
      shared.prefix[kDigit + 1] = before << kDigitBits | static_cast<std::uint64_t>(bin);
    }
    clear(thread, shared);
  }
};

}  // namespace softscope::cuda
