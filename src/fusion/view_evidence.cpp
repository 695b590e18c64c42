#include "fusion/view_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "fusion/visibility.h"

namespace softscope {
namespace {

constexpr int kPlaces = 9, kInPlace = 4;  // a block is compared in 3 x 3 places, row by row
constexpr int kShiftShare = 80;           // moved by this part of the image's width: 8 px of 640
constexpr int kBlockShare = 20;           // blocks are this part of the width: 32 px of 640
constexpr int kFewestPoints = 40;         // of a block
constexpr double kLeastVariance = 4;  // of a block's brightness: twice the noise of a good camera
constexpr double kSigmas = 3;

/// Sums for the correlation of the model's brightness with the image's, in one place.
struct Correlation {
  double image = 0, image_sq = 0, product = 0;
};

struct Block {
  int points = 0;
  double model = 0, model_sq = 0;
  std::array<Correlation, kPlaces> places;

  bool textured() const {
    return points >= kFewestPoints &&
           model_sq / points - std::pow(model / points, 2) > kLeastVariance;
  }
  double correlationAt(int place) const {
    const Correlation& sums = places[static_cast<std::size_t>(place)];
    const double covariance = sums.product - sums.image * model / points;
    const double variance = sums.image_sq - sums.image * sums.image / points;
    return variance > 0 ? covariance / std::sqrt(variance) : 0;  // the model's part is the same
  }
  bool bestInPlace() const {
    const double here = correlationAt(kInPlace);
    for (int place = 0; place < kPlaces; ++place)
      if (place != kInPlace && !(here > correlationAt(place))) return false;
    return here > 0;
  }
};

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
        block_px_(std::max(16, states.width_px / kBlockShare)),
        shift_px_(std::max(3, states.width_px / kShiftShare)) {}

  int rows() const { return (states_.height_px + block_px_ - 1) / block_px_; }

  Votes rowOfBlocks(int row) const {
    Votes votes;
    for (int u0 = 0; u0 < states_.width_px; u0 += block_px_) {
      const Block block = blockAt(u0, row * block_px_, &votes);
      if (!block.textured()) continue;
      ++votes.blocks;
      votes.in_place += block.bestInPlace();
    }
    return votes;
  }

 private:
  Block blockAt(int u0, int v0, Votes* votes) const {
    Block block;
    for (int v = v0; v < std::min(v0 + block_px_, states_.height_px); ++v)
      for (int u = u0; u < std::min(u0 + block_px_, states_.width_px); ++u) {
        if (states_.at(u, v) != PixelState::kSure) continue;
        const int point = drawn_.pointAt(u, v);
        if (point < 0) continue;
        ++votes->compared_px;
        votes->agreeing_px += depthAgrees(point, u, v);
        addBrightness(point, u, v, &block);
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

  void addBrightness(int point, int u, int v, Block* block) const {
    const ColourImage& image = observation_.colour;
    if (image.empty() || u < shift_px_ || v < shift_px_ || u + shift_px_ >= image.width_px ||
        v + shift_px_ >= image.height_px)
      return;
    const double model = toGray(model_.colours[static_cast<std::size_t>(point)]);
    ++block->points;
    block->model += model;
    block->model_sq += model * model;
    for (int place = 0; place < kPlaces; ++place) {
      const double seen =
          toGray(image.at(u + shift_px_ * (place % 3 - 1), v + shift_px_ * (place / 3 - 1)));
      Correlation& sums = block->places[static_cast<std::size_t>(place)];
      sums.image += seen;
      sums.image_sq += seen * seen;
      sums.product += model * seen;
    }
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
  constexpr double kChance = 1.0 / kPlaces;
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
