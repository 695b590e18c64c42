#include "deform/graph/cell_numbering.h"

namespace softscope {
namespace {

constexpr std::size_t kFewestSlots = 64;

std::uint64_t keyOfBlock(const Cube& cube) {
  const auto along = [](int at) {
    return static_cast<std::uint64_t>(at >> CellNumbering::kBlockBits);
  };
  constexpr int kBits = 21;
  return along(cube.z) << (2 * kBits) | along(cube.y) << kBits | along(cube.x);
}

CellNumbering::Block emptyBlock() {
  CellNumbering::Block block;
  block.fill(-1);
  return block;
}

}  // namespace

CellNumbering::CellNumbering(double cell_mm)
    : inverse_cell_(1 / cell_mm), slots_(kFewestSlots, -1) {}

std::size_t CellNumbering::slotOf(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ull) >> 32) & mask;
  while (slots_[slot] >= 0 && keys_[static_cast<std::size_t>(slots_[slot])] != key)
    slot = (slot + 1) & mask;
  return slot;
}

const CellNumbering::Block& CellNumbering::blockOf(const Cube& cube) const {
  static const Block kEmpty = emptyBlock();
  const int block = slots_[slotOf(keyOfBlock(cube))];
  return block < 0 ? kEmpty : blocks_[static_cast<std::size_t>(block)];
}

int CellNumbering::find(const Cube& cube) const { return blockOf(cube)[insideBlock(cube)]; }

int CellNumbering::findOrAdd(const Cube& cube) {
  const std::uint64_t key = keyOfBlock(cube);
  if (last_block_ < 0 || keys_[static_cast<std::size_t>(last_block_)] != key)
    last_block_ = findOrAddBlock(key);
  int& cell = blocks_[static_cast<std::size_t>(last_block_)][insideBlock(cube)];
  if (cell >= 0) return cell;
  cell = size();
  cubes_.push_back(cube);
  return cell;
}

int CellNumbering::findOrAddBlock(std::uint64_t key) {
  const std::size_t slot = slotOf(key);
  if (slots_[slot] >= 0) return slots_[slot];
  const int block = static_cast<int>(blocks_.size());
  slots_[slot] = block;
  keys_.push_back(key);
  blocks_.push_back(emptyBlock());
  if (2 * keys_.size() > slots_.size()) grow();
  return block;
}

void CellNumbering::grow() {
  slots_.assign(2 * slots_.size(), -1);
  for (std::size_t block = 0; block < keys_.size(); ++block)
    slots_[slotOf(keys_[block])] = static_cast<int>(block);
}

void NeighbourFinder::moveTo(const Cube& cube) {
  const auto along = [](int at) { return (at >> CellNumbering::kBlockBits) - 1; };
  const Cube first{along(cube.x), along(cube.y), along(cube.z)};
  if (first == first_) return;
  first_ = first;
  std::size_t at = 0;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x)
        around_[at++] = &table_.blockOf({(first.x + x) * CellNumbering::kBlockSide,
                                         (first.y + y) * CellNumbering::kBlockSide,
                                         (first.z + z) * CellNumbering::kBlockSide});
}

}  // namespace softscope
