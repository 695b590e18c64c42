#include "fusion/view_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "fusion/block_correlation.h"
#include "fusion/visibility.h"

namespace softscope {
namespace {

constexpr int kShiftShare = 80;  // blocks are moved by this part of the image's width: 8 px of 640
constexpr double kSigmas = 3;

/// What one row of blocks has to say.
struct Votes {
  int compared_px = 0, agreeing_px = 0, blocks = 0, in_place = 0;
};

class Comparison {
 public:
  Comparison(const DrawnPoints& drawn, const Observation& observation,
             const Raster<PixelState>& states, const PixelOptions& options)
      : drawn_(drawn),
        model_(drawn.model()),
        observation_(observation),
        states_(states),
        depth_step_(static_cast<float>(options.kEdgeStep)),
        block_px_(BlockCorrelation::blockPx(states.width_px)),
        shift_px_(std::max(3, states.width_px / kShiftShare)) {}

  int rows() const { return (states_.height_px + block_px_ - 1) / block_px_; }

  Votes rowOfBlocks(int row) const {
    Votes votes;
    for (int u0 = 0; u0 < states_.width_px; u0 += block_px_) {
      const BlockCorrelation block = blockAt(u0, row * block_px_, &votes);
      if (!block.textured()) continue;
      ++votes.blocks;
      votes.in_place += block.bestInPlace();
    }
    return votes;
  }

 private:
  BlockCorrelation blockAt(int u0, int v0, Votes* votes) const {
    BlockCorrelation block;
    for (int v = v0; v < std::min(v0 + block_px_, states_.height_px); ++v)
      for (int u = u0; u < std::min(u0 + block_px_, states_.width_px); ++u) {
        if (states_.at(u, v) != PixelState::kSure) continue;
        const int point = drawn_.pointAt(u, v);
        if (point < 0) continue;
        ++votes->compared_px;
        votes->agreeing_px += depthAgrees(point, u, v);
        if (!observation_.colour.empty())
          block.add(toGray(model_.colours[static_cast<std::size_t>(point)]), observation_.colour, u,
                    v, shift_px_);
      }
    return block;
  }

  bool depthAgrees(int point, int u, int v) const {
    const float measured_mm = observation_.depth.depth_mm.at(u, v);
    float tolerance_mm = depth_step_ * measured_mm;
    if (!observation_.depth.sigma_mm.empty())
      tolerance_mm = std::max(tolerance_mm,
                              static_cast<float>(kSigmas) * observation_.depth.sigma_mm.at(u, v));
    const float model_mm =
        drawn_.camera().toLeft(model_.positions_mm[static_cast<std::size_t>(point)]).z();
    return std::abs(model_mm - measured_mm) <= tolerance_mm;
  }

  const DrawnPoints& drawn_;
  const PointModel& model_;
  const Observation& observation_;
  const Raster<PixelState>& states_;
  const float depth_step_;
  const int block_px_, shift_px_;
};

}  // namespace

double ViewEvidence::confidence() const {
  constexpr double kChance = 1.0 / BlockCorrelation::kPlaces;
  if (!std::isfinite(depth_share) || !std::isfinite(image_share)) return 0;
  return std::min(depth_share, std::max(0.0, (image_share - kChance) / (1 - kChance)));
}

ViewEvidence viewEvidence(const DrawnPoints& drawn, const Observation& observation,
                          const Raster<PixelState>& states, const PixelOptions& options) {
  options.validate();
  observation.validate();
  requireStates(states, observation);
  const Comparison comparison(drawn, observation, states, options);
  std::vector<Votes> rows(static_cast<std::size_t>(comparison.rows()));
  parallelRanges(comparison.rows(), 1, [&](int begin, int end) {
    for (int row = begin; row < end; ++row)
      rows[static_cast<std::size_t>(row)] = comparison.rowOfBlocks(row);
  });
  Votes all;
  for (const Votes& row : rows) {
    all.compared_px += row.compared_px;
    all.agreeing_px += row.agreeing_px;
    all.blocks += row.blocks;
    all.in_place += row.in_place;
  }
  ViewEvidence evidence;
  evidence.blocks = all.blocks;
  if (all.compared_px > 0)
    evidence.depth_share = static_cast<double>(all.agreeing_px) / all.compared_px;
  if (all.blocks > 0) evidence.image_share = static_cast<double>(all.in_place) / all.blocks;
  return evidence;
}

}  // namespace softscope
