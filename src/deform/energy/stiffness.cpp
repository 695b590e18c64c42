#include "deform/energy/stiffness.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/median.h"
#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kFewestOfNode = 5;  // matches
constexpr int kFewestEdges = 20;
constexpr double kMeanOfMedianSquare = 1.268;  // of three normal components: 3 / 2.366
constexpr double kMedianVariance = 1.571;      // of a median, over that of the mean: pi / 2
constexpr double kEdgesOfMean = 4;    // as which the mean of all edges counts at each of them
constexpr double kStiffHalves = 2.5;  // strain, in squares of the noise, of half the stiffness
constexpr double kLeastStiffness = 1.0 / 64;
constexpr int kNodesPerMedians = 16;  // of a task

/// Node that carries most of a point.
std::size_t strongestNode(const WarpGraph& graph, const PointBinding& binding) {
  const auto strongest = std::max_element(binding.weights.begin(), binding.weights.end());
  return static_cast<std::size_t>(graph.stencils[static_cast<std::size_t>(binding.stencil)]
                                                [strongest - binding.weights.begin()]);
}

/// Whitened residuals of the matches, by node.
class NodeResiduals {
 public:
  NodeResiduals(const PointModel& model, const WarpGraph& graph, const CarriedMatches& carried)
      : start_(graph.size() + 1, 0), residuals_(static_cast<std::size_t>(carried.count())) {
    std::vector<std::size_t> node(carried.matches.size());
    for (std::size_t i = 0; i < node.size(); ++i) {
      if (carried.place[i] < 0) continue;
      node[i] = strongestNode(graph, model.bindings[carried.matches[i].model_point]);
      ++start_[node[i]];
    }
    int total = 0;
    for (int& first : start_) total += std::exchange(first, total);
    std::vector<int> next(start_);
    for (std::size_t i = 0; i < node.size(); ++i) {
      if (carried.place[i] < 0) continue;
      const KeyPointMatch& match = carried.matches[i];
      residuals_[next[node[i]]++] = match.sqrt_information * (match.target_mm - match.source_mm);
    }
  }

  int countAt(std::size_t node) const { return start_[node + 1] - start_[node]; }
  bool sufficeAt(std::size_t node) const { return countAt(node) >= kFewestOfNode; }

  Eigen::Vector3f medianAt(std::size_t node) const {
    Eigen::Vector3f median;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> values;
      for (int i = start_[node]; i < start_[node + 1]; ++i) values.push_back(residuals_[i][axis]);
      median[axis] = medianOf(std::move(values));
    }
    return median;
  }

  /// Mean square of the distances from the centres of the nodes, by their median; 0 without any.
  double noiseSquare(const std::vector<Eigen::Vector3f>& centres) const {
    std::vector<float> distances;
    for (std::size_t j = 0; j < centres.size(); ++j)
      for (int i = start_[j]; sufficeAt(j) && i < start_[j + 1]; ++i)
        distances.push_back((residuals_[i] - centres[j]).norm());
    if (distances.empty()) return 0;
    const double median = medianOf(std::move(distances));
    return kMeanOfMedianSquare * median * median;
  }

 private:
  std::vector<int> start_;  // of each node, and the end
  std::vector<Eigen::Vector3f> residuals_;
};

std::vector<Eigen::Vector3f> mediansOf(const NodeResiduals& residuals, std::size_t nodes) {
  std::vector<Eigen::Vector3f> medians(nodes, Eigen::Vector3f::Zero());
  parallelRanges(static_cast<int>(nodes), kNodesPerMedians, [&](int begin, int end) {
    for (std::size_t j = static_cast<std::size_t>(begin); j < static_cast<std::size_t>(end); ++j)
      if (residuals.sufficeAt(j)) medians[j] = residuals.medianAt(j);
  });
  return medians;
}

struct EdgeSum {
  double sum = 0, edges = 0;

  EdgeSum& operator+=(const EdgeSum& more) {
    sum += more.sum;
    edges += more.edges;
    return *this;
  }
  double mean() const { return sum / edges; }
};

}  // namespace

MatchedStrain strainOfMatches(const PointModel& model, const WarpGraph& graph,
                              const CarriedMatches& carried) {
  const NodeResiduals residuals(model, graph, carried);
  const std::vector<Eigen::Vector3f> centres = mediansOf(residuals, graph.size());
  MatchedStrain strain;
  strain.noise_square = residuals.noiseSquare(centres);
  EdgeSum all;
  std::vector<EdgeSum> at_node(graph.size());
  for (const GraphEdge& edge : graph.edges) {
    const auto first = static_cast<std::size_t>(edge.first);
    const auto second = static_cast<std::size_t>(edge.second);
    if (!residuals.sufficeAt(first) || !residuals.sufficeAt(second)) continue;
    const double noise = kMedianVariance * strain.noise_square *
                         (1.0 / residuals.countAt(first) + 1.0 / residuals.countAt(second));
    const EdgeSum one{edge.weight * ((centres[first] - centres[second]).squaredNorm() - noise), 1};
    for (EdgeSum* sum : {&all, &at_node[first], &at_node[second]}) *sum += one;
  }
  strain.edges = static_cast<int>(all.edges);
  if (strain.edges == 0) return strain;
  const EdgeSum mean{kEdgesOfMean * all.mean(), kEdgesOfMean};
  for (const GraphEdge& edge : graph.edges) {
    EdgeSum around = mean;
    around += at_node[static_cast<std::size_t>(edge.first)];
    around += at_node[static_cast<std::size_t>(edge.second)];
    strain.edges_square.push_back(around.mean());
  }
  return strain;
}

std::vector<double> stiffnessOf(const MatchedStrain& strain) {
  std::vector<double> factors(strain.edges_square.size(), 1);
  if (strain.edges < kFewestEdges) return factors;
  std::transform(strain.edges_square.begin(), strain.edges_square.end(), factors.begin(),
                 [&](double square) {
                   if (!(square > 0)) return 1.0;
                   const double ratio = square / (kStiffHalves * strain.noise_square);
                   return std::max(kLeastStiffness, 1 / (1 + ratio * ratio));
                 });
  return factors;
}

void followTissue(const DeformOptions& options, const PointModel& model, const WarpGraph& graph,
                  const CarriedMatches& carried, ConstraintSet* constraints) {
  if (!options.solver.follows_tissue) return;
  const std::vector<double> factors = stiffnessOf(strainOfMatches(model, graph, carried));
  for (std::size_t e = 0; e < factors.size(); ++e) constraints->stiffness[e] *= factors[e];
}

}  // namespace softscope
