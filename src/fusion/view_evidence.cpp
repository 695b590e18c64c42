#include "fusion/view_evidence.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "fusion/correlation_blocks.h"
#include "fusion/visibility.h"

namespace softscope {
namespace {

struct PixelVotes {
  int compared = 0, agreeing = 0;
};

class ViewComparison {
 public:
  ViewComparison(const DrawnPoints& drawn, const Observation& observation,
                 const Raster<PixelState>& states, const PixelOptions& options)
      : drawn_(drawn),
        model_(drawn.model()),
        observation_(observation),
        states_(states),
        depth_step_(static_cast<float>(options.kEdgeStep)),
        block_px_(BlockCorrelation::blockPx(states.width_px)),
        shift_px_(evidenceShiftPx(states.width_px)) {}

  PixelVotes addRowOfBlocks(int row, BlockCorrelation* blocks) const {
    PixelVotes votes;
    for (int u0 = 0; u0 < states_.width_px; u0 += block_px_)
      *blocks++ = blockAt(u0, row * block_px_, &votes);
    return votes;
  }

 private:
  BlockCorrelation blockAt(int u0, int v0, PixelVotes* votes) const {
    BlockCorrelation block;
    for (int v = v0; v < std::min(v0 + block_px_, states_.height_px); ++v)
      for (int u = u0; u < std::min(u0 + block_px_, states_.width_px); ++u) {
        if (states_.at(u, v) != PixelState::kAccepted) continue;
        const int point = drawn_.pointAt(u, v);
        if (point < 0) continue;
        ++votes->compared;
        votes->agreeing += depthAgrees(point, u, v);
        if (!observation_.colour.empty())
          block.add(toGray(model_.colours[static_cast<std::size_t>(point)]), observation_.colour, u,
                    v, shift_px_);
      }
    return block;
  }

  bool depthAgrees(int point, int u, int v) const {
    const Raster<float>& sigmas_mm = observation_.depth.sigma_mm;
    const float model_mm =
        drawn_.camera().toLeft(model_.positions_mm[static_cast<std::size_t>(point)]).z();
    return depthsAgree(model_mm, observation_.depth.depth_mm.at(u, v),
                       sigmas_mm.empty() ? 0.0f : sigmas_mm.at(u, v), depth_step_);
  }

  const DrawnPoints& drawn_;
  const PointModel& model_;
  const Observation& observation_;
  const Raster<PixelState>& states_;
  const float depth_step_;
  const int block_px_, shift_px_;
};

}  // namespace

double ViewEvidence::agreement() const {
  constexpr double kChance = 1.0 / BlockCorrelation::kPlaces;
  if (!std::isfinite(depth_share) || !std::isfinite(image_share)) return 0;
  return std::min(depth_share, std::max(0.0, (image_share - kChance) / (1 - kChance)));
}

ViewEvidence evidenceOf(int compared_px, int agreeing_px, CorrelationBlocks all) {
  all = withEnoughPoints(std::move(all));
  ViewEvidence evidence;
  int in_place = 0;
  for (const BlockCorrelation& block : all.blocks) {
    if (!block.textured()) continue;
    ++evidence.blocks;
    in_place += block.bestInPlace();
  }
  if (compared_px > 0) evidence.depth_share = static_cast<double>(agreeing_px) / compared_px;
  if (evidence.blocks > 0) evidence.image_share = static_cast<double>(in_place) / evidence.blocks;
  return evidence;
}

ViewEvidence viewEvidence(const DrawnPoints& drawn, const Observation& observation,
                          const Raster<PixelState>& states, const PixelOptions& options) {
  options.validate();
  observation.validate();
  requireStates(states, observation);
  const ViewComparison comparison(drawn, observation, states, options);
  CorrelationBlocks blocks = CorrelationBlocks::over(states.width_px, states.height_px);
  const auto columns = static_cast<std::size_t>(blocks.columns);
  std::vector<PixelVotes> votes(static_cast<std::size_t>(blocks.rows()));
  parallelRanges(blocks.rows(), 1, [&](int begin, int end) {
    for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row)
      votes[row] = comparison.addRowOfBlocks(static_cast<int>(row), &blocks.blocks[row * columns]);
  });
  PixelVotes all;
  for (const PixelVotes& row : votes) {
    all.compared += row.compared;
    all.agreeing += row.agreeing;
  }
  return evidenceOf(all.compared, all.agreeing, std::move(blocks));
}

}  // namespace softscope
