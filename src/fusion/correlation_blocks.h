// src/fusion/correlation_blocks.h: correlation of model and image in all blocks of an image.
#pragma once

#include <cstddef>
#include <vector>

#include "fusion/block_correlation.h"

namespace softscope {

/// Row by row.
struct CorrelationBlocks {
  int block_px = 1, columns = 0;
  std::vector<BlockCorrelation> blocks;

  /// Blocks without points, over an image of that size.
  static CorrelationBlocks over(int width_px, int height_px);
  /// From the sums of all blocks of an image of that size.
  static CorrelationBlocks from(const BlockSums* sums, int width_px, int height_px);

  /// The block that holds a pixel.
  BlockCorrelation& at(int u, int v) {
    return blocks[static_cast<std::size_t>(v / block_px * columns + u / block_px)];
  }
  int rows() const { return columns > 0 ? static_cast<int>(blocks.size()) / columns : 0; }
};

/// Where most points are in blocks of too few, as points of a surface that is stretched or close to
/// the scope are several pixels apart, four blocks become one.
CorrelationBlocks withEnoughPoints(CorrelationBlocks blocks);

}  // namespace softscope
