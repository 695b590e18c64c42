#include "deform/energy/stiffness.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/median.h"
#include "core/parallel.h"
#include "core/value_of_rank.h"

namespace softscope {
namespace {

constexpr int kFewestOfNode = 5;  // matches
constexpr int kFewestEdges = 20;
constexpr double kMeanOfMedianSquare = 1.268;  // of three normal components: 3 / 2.366
constexpr double kMedianVariance = 1.571;      // of a median, over that of the mean: pi / 2
constexpr double kStiffHalves = 2.5;  // strain, in squares of the noise, of half the stiffness
constexpr double kLeastStiffness = 1.0 / 64;
constexpr int kNodesPerMedians = 16;  // of a task

/// Whitened residuals of the matches, by node.
class NodeResiduals {
 public:
  NodeResiduals(const WarpGraph& graph, const CarriedMatches& carried)
      : start_(graph.size() + 1, 0), residuals_(static_cast<std::size_t>(carried.count())) {
    const int count = static_cast<int>(carried.matches.size());
    std::vector<std::int32_t> place = carried.node;
    toPlaces(&place, &start_);
    parallelRanges(count, kMatchesPerTask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        if (place[i] < 0) continue;
        const KeyPointMatch& match = carried.matches[i];
        residuals_[place[i]] = match.sqrt_information * (match.target_mm - match.source_mm);
      }
    });
    findCentres();
  }

  int countAt(std::size_t node) const { return start_[node + 1] - start_[node]; }
  bool sufficeAt(std::size_t node) const { return countAt(node) >= kFewestOfNode; }
  /// Median of each component; where there are too few, 0.
  const Eigen::Vector3f& centreAt(std::size_t node) const { return centres_[node]; }

  /// Mean square of the distances from the centres of the nodes, by their median; 0 without any.
  double noiseSquare() const {
    std::vector<float> distances;
    distances.reserve(distances_.size());
    for (std::size_t j = 0; j < centres_.size(); ++j)
      if (sufficeAt(j))
        distances.insert(distances.end(), distances_.begin() + start_[j],
                         distances_.begin() + start_[j + 1]);
    if (distances.empty()) return 0;
    const std::size_t middle = distances.size() / 2;
    const double median = absoluteOfRank({std::move(distances)}, middle);
    return kMeanOfMedianSquare * median * median;
  }

 private:
  void findCentres() {
    centres_.assign(start_.size() - 1, Eigen::Vector3f::Zero());
    distances_.resize(residuals_.size());
    parallelRanges(static_cast<int>(centres_.size()), kNodesPerMedians, [&](int begin, int end) {
      std::vector<float> values;
      for (std::size_t j = static_cast<std::size_t>(begin); j < static_cast<std::size_t>(end); ++j)
        if (sufficeAt(j)) findCentre(j, &values);
    });
  }
  /// Overwrites *values and reuses its memory.
  void findCentre(std::size_t node, std::vector<float>* values) {
    const auto count = static_cast<std::size_t>(countAt(node));
    values->resize(count);
    Eigen::Vector3f& centre = centres_[node];
    const Eigen::Vector3f* own = &residuals_[start_[node]];
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < count; ++i) (*values)[i] = own[i][axis];
      centre[axis] = medianWithin(values->begin(), values->end());
    }
    for (std::size_t i = 0; i < count; ++i)
      distances_[static_cast<std::size_t>(start_[node]) + i] = (own[i] - centre).norm();
  }

  std::vector<int> start_;  // of each node, and the end
  std::vector<Eigen::Vector3f> residuals_, centres_;
  std::vector<float> distances_;  // of the residuals, from the centres of their nodes
};

}  // namespace

MatchedStrain strainOfMatches(const WarpGraph& graph, const CarriedMatches& carried) {
  const NodeResiduals residuals(graph, carried);
  MatchedStrain strain;
  strain.noise_square = residuals.noiseSquare();
  double sum = 0;
  for (const GraphEdge& edge : graph.edges) {
    const auto first = static_cast<std::size_t>(edge.first);
    const auto second = static_cast<std::size_t>(edge.second);
    if (!residuals.sufficeAt(first) || !residuals.sufficeAt(second)) continue;
    const double apart = (residuals.centreAt(first) - residuals.centreAt(second)).squaredNorm();
    const double noise = kMedianVariance * strain.noise_square *
                         (1.0 / residuals.countAt(first) + 1.0 / residuals.countAt(second));
    sum += edge.weight * (apart - noise);
    ++strain.edges;
  }
  if (strain.edges > 0) strain.edges_square = sum / strain.edges;
  return strain;
}

double stiffnessOf(const MatchedStrain& strain) {
  if (strain.edges < kFewestEdges || !(strain.edges_square > 0)) return 1;
  if (!(strain.noise_square > 0)) return kLeastStiffness;
  const double ratio = strain.edges_square / (kStiffHalves * strain.noise_square);
  return std::max(kLeastStiffness, 1 / (1 + ratio * ratio));
}

double tissueStiffness(const DeformOptions& options, const WarpGraph& graph,
                       const CarriedMatches& carried) {
  if (!options.solver.follows_tissue) return 1;
  return stiffnessOf(strainOfMatches(graph, carried));
}

}  // namespace softscope
