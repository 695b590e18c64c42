// cuda/fusion/fusion_cells.h: hash table of cells in memory of the device.
#pragma once

#include "cuda/device/kernel.h"
#include "fusion/cell_table.h"

namespace softscope::cuda {

/// Open addressing; which slot a cell gets depends on the order of threads, nothing else does. No
/// more than half of the slots are taken.
struct CellSlots {
  unsigned long long* keys;  // kNoCell: free
  std::size_t count;         // a power of two

  /// The slot of the cell, which is taken for it where there is none.
  SOFTSCOPE_HD std::int32_t take(CellKey key) const {
    constexpr unsigned long long kFree = kNoCell;
    std::size_t slot = firstSlot(key, count - 1);
    for (;; slot = (slot + 1) & (count - 1)) {
      const unsigned long long held = atomicClaim(&keys[slot], kFree, key);
      if (held == kFree || held == key) return static_cast<std::int32_t>(slot);
    }
  }
};

/// Heap sort in place: no list is long, but none may take long.
SOFTSCOPE_HD inline void sortAscending(std::int32_t* list, int count) {
  const auto sink = [list](int hole, int end, std::int32_t value) {
    for (int child = 2 * hole + 1; child < end; child = 2 * hole + 1) {
      if (child + 1 < end && list[child + 1] > list[child]) ++child;
      if (list[child] <= value) break;
      list[hole] = list[child];
      hole = child;
    }
    list[hole] = value;
  };
  for (int root = count / 2 - 1; root >= 0; --root) sink(root, count, list[root]);
  for (int end = count - 1; end > 0; --end) {
    const std::int32_t value = list[end];
    list[end] = list[0];
    sink(0, end, value);
  }
}

}  // namespace softscope::cuda
