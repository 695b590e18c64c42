#include "fusion/correlation_blocks.h"

#include <cstddef>

namespace softscope {
namespace {

bool mostPointsAreInFullBlocks(const CorrelationBlocks& all) {
  int points = 0, in_full = 0;
  for (const BlockCorrelation& block : all.blocks) {
    points += block.points();
    if (block.hasEnoughPoints()) in_full += block.points();
  }
  return 2 * in_full >= points;
}

/// Each block is that of 2 x 2.
CorrelationBlocks pooled(const CorrelationBlocks& fine) {
  CorrelationBlocks coarse{2 * fine.block_px, (fine.columns + 1) / 2, {}};
  coarse.blocks.resize(static_cast<std::size_t>(coarse.columns) *
                       static_cast<std::size_t>((fine.rows() + 1) / 2));
  for (int row = 0; row < fine.rows(); ++row)
    for (int column = 0; column < fine.columns; ++column)
      coarse.blocks[static_cast<std::size_t>(row / 2 * coarse.columns + column / 2)] +=
          fine.blocks[static_cast<std::size_t>(row * fine.columns + column)];
  return coarse;
}

}  // namespace

CorrelationBlocks CorrelationBlocks::over(int width_px, int height_px) {
  const int block_px = BlockCorrelation::blockPx(width_px);
  const auto along = [&](int px) { return (px + block_px - 1) / block_px; };
  CorrelationBlocks all{block_px, along(width_px), {}};
  all.blocks.resize(static_cast<std::size_t>(all.columns) *
                    static_cast<std::size_t>(along(height_px)));
  return all;
}

CorrelationBlocks CorrelationBlocks::from(const BlockSums* sums, int width_px, int height_px) {
  CorrelationBlocks all = over(width_px, height_px);
  for (BlockCorrelation& block : all.blocks) block = BlockCorrelation(*sums++);
  return all;
}

CorrelationBlocks withEnoughPoints(CorrelationBlocks blocks) {
  while (blocks.blocks.size() > 1 && !mostPointsAreInFullBlocks(blocks)) blocks = pooled(blocks);
  return blocks;
}

}  // namespace softscope
