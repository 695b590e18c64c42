// cuda/match/match_list.h: kernel bodies that compact matches to a list, by rows.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/match/match_search.h"

namespace softscope::cuda {

/// Positions of the matches in half pixels, one bit each. They
/// are unique: a node p of level k is at 2^k p + (2^k - 1) / 2.
struct PlaceBits {
  std::uint32_t* words;
  int* counts;  // of each row
  int* starts;  // of each row, in the list
  int columns;  // words
  int rows;     // half pixels

  SOFTSCOPE_HD static int halfPixels(float px) { return static_cast<int>(2 * px); }
};
struct MarkPlacesBody {
  const SlotMatch* matches;
  PlaceBits places;
  SOFTSCOPE_HD void operator()(int slot) const {
    if (matches[slot].found == 0) return;
    const int x = PlaceBits::halfPixels(matches[slot].model_u),
              y = PlaceBits::halfPixels(matches[slot].model_v);
    atomicUnite(&places.words[y * places.columns + x / 32], 1u << x % 32);
    atomicPlus(&places.counts[y], 1);
  }
};
/// Prefix sum of the counts of rows; one block.
struct RowStartsKernel {
  static constexpr int kThreads = 1024, kPhases = 5, kParts = 32;
  static constexpr int kEach = kThreads / kParts;
  struct Shared {
    int sums[kThreads + kParts];  // a gap after each part, against bank conflicts
    int parts[kParts];
  };
  using Local = Nothing;
  PlaceBits places;
  int* match_count;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int each = (places.rows + kThreads - 1) / kThreads;
    const int first = at.thread * each,
              last = first + each < places.rows ? first + each : places.rows;
    if constexpr (kPhase == 0) {
      int sum = 0;
      for (int i = first; i < last; ++i) sum += places.counts[i];
      shared.sums[padded(at.thread)] = sum;
    } else if constexpr (kPhase == 1) {
      if (at.thread >= kParts) return;
      int sum = 0;
      for (int k = 0; k < kEach; ++k) sum += shared.sums[padded(at.thread * kEach) + k];
      shared.parts[at.thread] = sum;
    } else if constexpr (kPhase == 2) {
      if (at.thread == 0) *match_count = startsOf(shared.parts, kParts, 0);
    } else if constexpr (kPhase == 3) {
      if (at.thread < kParts)
        startsOf(shared.sums + padded(at.thread * kEach), kEach, shared.parts[at.thread]);
    } else {
      int start = shared.sums[padded(at.thread)];
      for (int i = first; i < last; ++i) {
        places.starts[i] = start;
        start += places.counts[i];
      }
    }
  }

 private:
  SOFTSCOPE_HD static int padded(int k) { return k + k / kEach; }
  /// Counts become start indices; returns the end.
  SOFTSCOPE_HD static int startsOf(int* counts, int count, int start) {
    for (int k = 0; k < count; ++k) {
      const int own = counts[k];
      counts[k] = start;
      start += own;
    }
    return start;
  }
};
/// Writes each match to its position in the list: by rows, from left to right.
struct ListMatchesBody {
  const SlotMatch* matches;
  PlaceBits places;
  SlotMatch* list;
  SOFTSCOPE_HD void operator()(int slot) const {
    const SlotMatch match = matches[slot];
    if (match.found == 0) return;
    const int x = PlaceBits::halfPixels(match.model_u), y = PlaceBits::halfPixels(match.model_v);
    const std::uint32_t* row = places.words + y * places.columns;
    int place = places.starts[y] + countBits(row[x / 32] & ((1u << x % 32) - 1));
    for (int k = 0; k < x / 32; ++k) place += countBits(row[k]);
    list[place] = match;
  }
};

}  // namespace softscope::cuda
