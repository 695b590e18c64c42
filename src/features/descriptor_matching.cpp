#include "features/descriptor_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/parallel.h"
#include "features/kernels.h"
#include "features/match_formulas.h"

namespace softscope {
namespace {

/// Distances from one descriptor to all in a window of another image's nodes.
class Window {
 public:
  /// Nodes around (column, row), cut at the grid's ends.
  void compare(const std::uint8_t* one, const DenseDescriptors& others, int column, int row,
               int reach) {
    nearest_ = {kNoDistance, 0, 0};
    c0_ = std::max(column - reach, 0);
    r0_ = std::max(row - reach, 0);
    columns_ = std::min(column + reach, others.columns() - 1) - c0_ + 1;
    rows_ = std::min(row + reach, others.rows() - 1) - r0_ + 1;
    if (columns_ <= 0 || rows_ <= 0) return;
    stride_ = (columns_ + kDistanceLanes - 1) / kDistanceLanes * kDistanceLanes;
    values_.resize(std::max(values_.size(),
                            static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows_)));
    nearest_ =
        featureKernels().searchWindow(one,
                                      {others.descriptor(c0_, r0_), others.valid.row(r0_) + c0_,
                                       others.columns(), columns_, rows_},
                                      {values_.data(), stride_});
  }

  bool found() const { return nearest_.distance < kNoDistance; }
  int best() const { return nearest_.distance; }
  int bestColumn() const { return c0_ + nearest_.column; }
  int bestRow() const { return r0_ + nearest_.row; }

  /// Least distance of nodes more than `reach` columns or rows away from the best one.
  int secondBest(int reach) {
    return featureKernels().secondBestDistance({values_.data(), stride_}, rows_, nearest_, reach);
  }

  /// Where parabolas through the best node and its neighbours are lowest, in nodes; 0 at the rim.
  Eigen::Vector2f parabolaShift() const {
    const auto [best, column, row] = nearest_;
    return {softscope::parabolaShift(at(column - 1, row), best, at(column + 1, row)),
            softscope::parabolaShift(at(column, row - 1), best, at(column, row + 1))};
  }

 private:
  int at(int c, int r) const {
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return kNoDistance;
    return values_[static_cast<std::size_t>(r) * static_cast<std::size_t>(stride_) +
                   static_cast<std::size_t>(c)];
  }

  int c0_ = 0, r0_ = 0, columns_ = 0, rows_ = 0, stride_ = 0;
  NearestNode nearest_{kNoDistance, 0, 0};
  std::vector<std::uint16_t> values_;
};

Eigen::Vector2f pixelOf(const DenseDescriptors& grid, int column, int row) {
  return {static_cast<float>(grid.first_px + column * grid.grid_px),
          static_cast<float>(grid.first_px + row * grid.grid_px)};
}

/// One node's match and its ratio; ratio 1 = none.
struct Candidate {
  int column = 0, row = 0;
  Eigen::Vector2i predicted = Eigen::Vector2i::Zero();  // shift, nodes
  float ratio = 1;
  Eigen::Vector2f shift = Eigen::Vector2f::Zero();
};

class PairOfGrids {
 public:
  PairOfGrids(const DenseDescriptors& model, const DenseDescriptors& live,
              const ShiftField& predicted, const SearchReach& reach, float max_ratio)
      : model_(model), live_(live), predicted_(predicted), reach_(reach), max_ratio_(max_ratio) {}

  Candidate candidate(int column, int row, Window* window) const {
    Candidate none;
    if (model_.valid.at(column, row) == 0) return none;
    const Eigen::Vector2f shift =
        predicted_.at(pixelOf(model_, column, row)) / static_cast<float>(model_.grid_px);
    const Eigen::Vector2i nodes(static_cast<int>(std::lround(shift.x())),
                                static_cast<int>(std::lround(shift.y())));
    window->compare(model_.descriptor(column, row), live_, column + nodes.x(), row + nodes.y(),
                    reach_.search);
    if (!window->found() || reach_.isAtRim(window->bestColumn() - column - nodes.x(),
                                           window->bestRow() - row - nodes.y()))
      return none;
    const float ratio = distanceRatio(window->best(), window->secondBest(reach_.elsewhere));
    if (!(ratio < max_ratio_)) return none;
    return {window->bestColumn(), window->bestRow(), nodes, ratio, window->parabolaShift()};
  }

  bool mutual(int column, int row, const Candidate& there, Window* window) const {
    window->compare(live_.descriptor(there.column, there.row), model_,
                    there.column - there.predicted.x(), there.row - there.predicted.y(),
                    reach_.search);
    return window->found() && std::abs(window->bestColumn() - column) <= reach_.mutual &&
           std::abs(window->bestRow() - row) <= reach_.mutual;
  }

 private:
  const DenseDescriptors& model_;
  const DenseDescriptors& live_;
  const ShiftField& predicted_;
  SearchReach reach_;
  float max_ratio_;
};

/// The most distinct node of a square that is mutual; tried in the order of distinctness.
bool bestOfSquare(const PairOfGrids& grids, int c0, int r0, int c1, int r1, Window* window,
                  std::vector<std::pair<Candidate, Eigen::Vector2i>>* tried, NodeMatch* match,
                  const DenseDescriptors& model, const DenseDescriptors& live) {
  tried->clear();
  for (int r = r0; r < r1; ++r)
    for (int c = c0; c < c1; ++c) {
      const Candidate candidate = grids.candidate(c, r, window);
      if (candidate.ratio < 1) tried->emplace_back(candidate, Eigen::Vector2i(c, r));
    }
  std::stable_sort(tried->begin(), tried->end(),
                   [](const auto& a, const auto& b) { return a.first.ratio < b.first.ratio; });
  for (const auto& [there, node] : *tried) {
    if (!grids.mutual(node.x(), node.y(), there, window)) continue;
    match->model_px = pixelOf(model, node.x(), node.y());
    match->live_px = pixelOf(live, there.column, there.row);
    match->parabola_px = match->live_px + static_cast<float>(live.grid_px) * there.shift;
    match->ratio = there.ratio;
    return true;
  }
  return false;
}

}  // namespace

std::vector<NodeMatch> matchDescriptors(const DenseDescriptors& model, const DenseDescriptors& live,
                                        const ShiftField& predicted, double radius_px,
                                        const MatcherOptions& options) {
  if (model.valid.empty() || live.valid.empty()) return {};
  const PairOfGrids grids(model, live, predicted, searchReach(options, model.grid_px, radius_px),
                          static_cast<float>(options.kMaxRatio));
  const int side = std::max(1, options.kSpacingPx / model.grid_px);
  const int square_rows = (model.rows() + side - 1) / side;
  std::vector<std::vector<NodeMatch>> found(static_cast<std::size_t>(square_rows));
  parallelRanges(square_rows, 4, [&](int begin, int end) {
    Window window;
    std::vector<std::pair<Candidate, Eigen::Vector2i>> tried;
    NodeMatch match;
    for (int r = begin; r < end; ++r)
      for (int c = 0; c < model.columns(); c += side)
        if (bestOfSquare(grids, c, r * side, std::min(c + side, model.columns()),
                         std::min((r + 1) * side, model.rows()), &window, &tried, &match, model,
                         live))
          found[static_cast<std::size_t>(r)].push_back(match);
  });
  std::vector<NodeMatch> all;
  for (const auto& row : found) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace softscope
