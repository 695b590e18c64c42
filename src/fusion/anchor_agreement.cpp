#include "fusion/anchor_agreement.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

/// As for matched windows: anchors with a lower correlation are not used.
constexpr double kLeastAnchorCorrelation = 0.7;

bool agree(const BlockCorrelation& block) {
  return block.textured() && block.bestCorrelation() >= kLeastAnchorCorrelation;
}

}  // namespace

AnchorAgreement::AnchorAgreement(int width_px, CorrelationBlocks blocks) : width_px_(width_px) {
  blocks = withEnoughPoints(std::move(blocks));
  block_px_ = blocks.block_px;
  agrees_ = Mask(blocks.columns, blocks.rows(), 0);
  for (std::size_t block = 0; block < agrees_.size(); ++block)
    agrees_.values[block] = agree(blocks.blocks[block]);
}

AnchorAgreement::AnchorAgreement(const PointModel& model, const Observation& observation,
                                 const Visibility& visibility) {
  const ColourImage& image = observation.colour;
  if (image.empty()) return;
  CorrelationBlocks all = CorrelationBlocks::over(image.width_px, image.height_px);
  const int count = static_cast<int>(model.size());
  const int tasks = (count + kPointsPerTask - 1) / kPointsPerTask;
  std::vector<CorrelationBlocks> parts(static_cast<std::size_t>(tasks));
  parallelRanges(tasks, 1, [&](int begin, int end) {
    for (int task = begin; task < end; ++task) {
      CorrelationBlocks& part = parts[static_cast<std::size_t>(task)];
      part = CorrelationBlocks::over(image.width_px, image.height_px);
      for (int k = task * kPointsPerTask; k < std::min(count, (task + 1) * kPointsPerTask); ++k) {
        const PointSight& point = visibility.points[static_cast<std::size_t>(k)];
        if (point.sight != Sight::kSeen) continue;
        const int u = point.pixel % image.width_px, v = point.pixel / image.width_px;
        part.at(u, v).add(model.anchors[static_cast<std::size_t>(k)], image, u, v, kSlipPx);
      }
    }
  });
  for (const CorrelationBlocks& part : parts)
    for (std::size_t block = 0; block < all.blocks.size(); ++block)
      all.blocks[block] += part.blocks[block];
  *this = AnchorAgreement(image.width_px, std::move(all));
}

}  // namespace softscope
