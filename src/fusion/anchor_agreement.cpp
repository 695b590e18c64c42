#include "fusion/anchor_agreement.h"

#include <algorithm>

#include "core/parallel.h"
#include "fusion/block_correlation.h"

namespace softscope {
namespace {

constexpr int kSlipPx = 1;  // of the texture in the image that is no change of the tissue

/// As of windows that are matched: below it the anchors are of no use there.
constexpr double kLeastAnchorCorrelation = 0.7;

bool agree(const BlockCorrelation& block) {
  return block.textured() && block.bestCorrelation() >= kLeastAnchorCorrelation;
}

}  // namespace

AnchorAgreement::AnchorAgreement(const PointModel& model, const Observation& observation,
                                 const Visibility& visibility) {
  const ColourImage& image = observation.colour;
  if (image.empty()) return;
  width_px_ = image.width_px;
  block_px_ = BlockCorrelation::blockPx(width_px_);
  agrees_ = Mask((image.width_px + block_px_ - 1) / block_px_,
                 (image.height_px + block_px_ - 1) / block_px_, 0);
  const int count = static_cast<int>(model.size());
  const int tasks = (count + kPointsATask - 1) / kPointsATask;
  std::vector<std::vector<BlockCorrelation>> parts(static_cast<std::size_t>(tasks));
  parallelRanges(tasks, 1, [&](int begin, int end) {
    for (int task = begin; task < end; ++task) {
      std::vector<BlockCorrelation>& blocks = parts[static_cast<std::size_t>(task)];
      blocks.resize(agrees_.size());
      for (int k = task * kPointsATask; k < std::min(count, (task + 1) * kPointsATask); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const PointSight& point = visibility.points[i];
        if (point.sight != Sight::kSeen) continue;
        blocks[blockOf(point.pixel)].add(model.anchors[i], image, point.pixel % width_px_,
                                         point.pixel / width_px_, kSlipPx);
      }
    }
  });
  for (std::size_t block = 0; block < agrees_.size(); ++block) {
    BlockCorrelation all;
    for (const std::vector<BlockCorrelation>& blocks : parts) all += blocks[block];
    agrees_.values[block] = agree(all);
  }
}

}  // namespace softscope
