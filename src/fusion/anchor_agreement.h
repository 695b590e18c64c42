// src/fusion/anchor_agreement.h: image blocks that agree with the anchors' colours.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/point_model.h"
#include "fusion/correlation_blocks.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// Blocks of the image whose points' anchors correlate with the image, in place or one pixel aside:
/// docs/fusion.md (F24). A slip of the texture is no change of the tissue.
class AnchorAgreement {
 public:
  /// Nothing agrees.
  AnchorAgreement() = default;

  /// `visibility` is about `model`. Same result on any number of threads.
  AnchorAgreement(const PointModel& model, const Observation& observation,
                  const Visibility& visibility);

  /// From the sums of all blocks of an image of that width.
  AnchorAgreement(int width_px, CorrelationBlocks blocks);
  static constexpr int kSlipPx = 1;  // of the texture in the image that is no change of the tissue

  /// Whether the anchors of the block that holds the pixel (index into the image) agree.
  bool at(std::int32_t pixel) const {
    return !agrees_.empty() && agrees_.values[blockOf(pixel)] != 0;
  }
  /// Not 0 for blocks that agree, row by row, of that many pixels a side; empty: nothing agrees.
  const Mask& blocks() const { return agrees_; }
  int blockPx() const { return block_px_; }
  int imageWidthPx() const { return width_px_; }

 private:
  std::size_t blockOf(std::int32_t pixel) const {
    const int column = pixel % width_px_ / block_px_, row = pixel / width_px_ / block_px_;
    return static_cast<std::size_t>(row * agrees_.width_px + column);
  }

  int width_px_ = 0, block_px_ = 1;
  Mask agrees_;  // one value a block
};

}  // namespace softscope
