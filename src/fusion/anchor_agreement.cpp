#include "fusion/anchor_agreement.h"

#include <algorithm>

#include "core/parallel.h"
#include "fusion/block_correlation.h"

namespace softscope {
namespace {

/// As for matched windows: anchors with a lower correlation are not used.
constexpr double kLeastAnchorCorrelation = 0.7;

bool agree(const BlockCorrelation& block) {
  return block.textured() && block.bestCorrelation() >= kLeastAnchorCorrelation;
}

}  // namespace

AnchorAgreement::AnchorAgreement(int width_px, int height_px)
    : width_px_(width_px),
      block_px_(BlockCorrelation::blockPx(width_px)),
      agrees_((width_px + block_px_ - 1) / block_px_, (height_px + block_px_ - 1) / block_px_, 0) {}

AnchorAgreement::AnchorAgreement(int width_px, int height_px, const BlockSums* blocks)
    : AnchorAgreement(width_px, height_px) {
  for (std::size_t block = 0; block < agrees_.size(); ++block)
    agrees_.values[block] = agree(BlockCorrelation(blocks[block]));
}

AnchorAgreement::AnchorAgreement(const PointModel& model, const Observation& observation,
                                 const Visibility& visibility) {
  const ColourImage& image = observation.colour;
  if (image.empty()) return;
  *this = AnchorAgreement(image.width_px, image.height_px);
  const int count = static_cast<int>(model.size());
  const int tasks = (count + kPointsPerTask - 1) / kPointsPerTask;
  std::vector<std::vector<BlockCorrelation>> parts(static_cast<std::size_t>(tasks));
  parallelRanges(tasks, 1, [&](int begin, int end) {
    for (int task = begin; task < end; ++task) {
      std::vector<BlockCorrelation>& blocks = parts[static_cast<std::size_t>(task)];
      blocks.resize(agrees_.size());
      for (int k = task * kPointsPerTask; k < std::min(count, (task + 1) * kPointsPerTask); ++k) {
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
