// src/fusion/cell_table.h: hash grid of points without bounds.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/hd.h"

namespace softscope {

/// A cell's three coordinates, 21 bits each; x lowest. kNoCell for what lies in none.
using CellKey = std::uint64_t;
constexpr CellKey kNoCell = ~CellKey{0};
constexpr float kCellsEachWay = 1 << 20;

/// NaN, infinite and absurdly distant points (2^20 cells away) lie in no cell. mm.
SOFTSCOPE_HD inline CellKey cellKey(const Eigen::Vector3f& point_mm,
                                    const Eigen::Vector3f& cell_mm) {
  CellKey key = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const float cell = std::floor(point_mm[axis] / cell_mm[axis]);
    if (!(cell >= -kCellsEachWay && cell < kCellsEachWay)) return kNoCell;
    const std::int32_t shifted = static_cast<std::int32_t>(cell) + (1 << 20);
    key = key << 21 | static_cast<CellKey>(shifted);
  }
  return key;
}

/// Where the search for a key begins in a table of mask + 1 slots, a power of two. Eight cells that
/// follow each other in x share a cache line's neighbourhood, as surface points come row by row.
SOFTSCOPE_HD inline std::size_t firstSlot(CellKey key, std::size_t mask) {
  const CellKey mixed = (key >> 3) * 0x9E3779B97F4A7C15ULL;
  return static_cast<std::size_t>((mixed >> 29) << 3 | (key & 7)) & mask;
}

/// Open addressing over indices whose keys the caller holds.
class CellHashTable {
 public:
  static constexpr std::int32_t kEmpty = -1;

  /// Room for `count` entries.
  explicit CellHashTable(std::size_t count) {
    std::size_t size = 16;
    while (size < 2 * count) size *= 2;
    slots_.assign(size, kEmpty);
  }

  /// The first slot on the key's way that is empty or holds an index for which same(index) is true.
  template <class Same>
  std::int32_t& find(CellKey key, const Same& same) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = firstSlot(key, mask);
    while (slots_[slot] != kEmpty && !same(slots_[slot])) slot = (slot + 1) & mask;
    return slots_[slot];
  }

 private:
  std::vector<std::int32_t> slots_;
};

}  // namespace softscope
