#include "deform/graph/cell_numbering.h"

namespace softscope {
namespace {

constexpr std::size_t kFewestSlots = 64;
constexpr int kKeyBits = 21;  // of a key, per coordinate

std::uint64_t keyOfBlock(const Cube& cube) {
  const auto along = [](int at) {
    return static_cast<std::uint64_t>(at >> CellNumbering::kBlockBits);
  };
  return along(cube.z) << (2 * kKeyBits) | along(cube.y) << kKeyBits | along(cube.x);
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

Cube CellNumbering::firstCubeOf(int block) const {
  const auto along = [&](int shift) {
    const std::uint64_t at = keys_[static_cast<std::size_t>(block)] >> shift;
    return static_cast<int>(at & ((1u << kKeyBits) - 1)) << kBlockBits;
  };
  return {along(0), along(kKeyBits), along(2 * kKeyBits)};
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

BlockWithRim::BlockWithRim(const CellNumbering& table, int block) {
  constexpr int kBlockSide = CellNumbering::kBlockSide;
  const Cube first = table.firstCubeOf(block);
  struct Span {
    int block, begin, end;  // cells from -1, of the block before, to kBlockSide, of the one behind
  };
  constexpr Span kSpans[] = {{-1, -1, 0}, {0, 0, kBlockSide}, {1, kBlockSide, kBlockSide + 1}};
  for (const Span& along_z : kSpans)
    for (const Span& along_y : kSpans)
      for (const Span& along_x : kSpans) {
        const CellNumbering::Block& cells = table.blockOf({first.x + along_x.block * kBlockSide,
                                                           first.y + along_y.block * kBlockSide,
                                                           first.z + along_z.block * kBlockSide});
        for (int z = along_z.begin; z < along_z.end; ++z)
          for (int y = along_y.begin; y < along_y.end; ++y)
            for (int x = along_x.begin; x < along_x.end; ++x)
              cells_[at(x + 1, y + 1, z + 1)] = cells[CellNumbering::insideBlock({x, y, z})];
      }
}

}  // namespace softscope
