#include "deform/energy/stiffness.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/median.h"

namespace softscope {
namespace {

using Residuals = std::vector<Eigen::Vector3f>;

constexpr std::size_t kFewestOfNode = 5;  // matches
constexpr int kFewestEdges = 20;
constexpr double kMeanOfMedianSquare = 1.268;  // of three normal components: 3 / 2.366
constexpr double kMedianVariance = 1.571;      // of a median, over that of the mean: pi / 2
constexpr double kStiffHalves = 2.5;  // strain, in squares of the noise, of half the stiffness
constexpr double kLeastStiffness = 1.0 / 64;

/// Node that carries most of a match.
std::int32_t strongestNode(const WarpGraph& graph, const PointBinding& binding) {
  const auto strongest = std::max_element(binding.weights.begin(), binding.weights.end());
  return graph.stencils[static_cast<std::size_t>(binding.stencil)]
                       [static_cast<std::size_t>(strongest - binding.weights.begin())];
}

std::vector<Residuals> residualsByNode(const PointModel& model, const WarpGraph& graph,
                                       const std::vector<KeyPointMatch>& matches) {
  const CarriedMatches carried(model, graph, matches);
  std::vector<Residuals> of_node(graph.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (carried.place[i] < 0) continue;
    const KeyPointMatch& match = matches[i];
    const std::int32_t node = strongestNode(graph, model.bindings[match.model_point]);
    of_node[static_cast<std::size_t>(node)].push_back(match.sqrt_information *
                                                      (match.target_mm - match.source_mm));
  }
  return of_node;
}

Eigen::Vector3f medianOfEach(const Residuals& residuals) {
  Eigen::Vector3f median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    values.reserve(residuals.size());
    for (const Eigen::Vector3f& residual : residuals) values.push_back(residual[axis]);
    median[axis] = medianOf(std::move(values));
  }
  return median;
}

}  // namespace

MatchedStrain strainOfMatches(const PointModel& model, const WarpGraph& graph,
                              const std::vector<KeyPointMatch>& matches) {
  const std::vector<Residuals> of_node = residualsByNode(model, graph, matches);
  Residuals centres(graph.size(), Eigen::Vector3f::Zero());
  std::vector<float> distances;
  for (std::size_t j = 0; j < of_node.size(); ++j) {
    if (of_node[j].size() < kFewestOfNode) continue;
    centres[j] = medianOfEach(of_node[j]);
    for (const Eigen::Vector3f& residual : of_node[j])
      distances.push_back((residual - centres[j]).norm());
  }
  MatchedStrain strain;
  if (distances.empty()) return strain;
  const double median = medianOf(std::move(distances));
  strain.noise_square = kMeanOfMedianSquare * median * median;
  double sum = 0;
  for (const GraphEdge& edge : graph.edges) {
    const auto first = static_cast<std::size_t>(edge.first);
    const auto second = static_cast<std::size_t>(edge.second);
    const std::size_t n = of_node[first].size(), m = of_node[second].size();
    if (std::min(n, m) < kFewestOfNode) continue;
    const double noise = kMedianVariance * strain.noise_square *
                         (1 / static_cast<double>(n) + 1 / static_cast<double>(m));
    sum += edge.weight * ((centres[first] - centres[second]).squaredNorm() - noise);
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

DeformOptions stiffer(const DeformOptions& options, double factor) {
  DeformOptions scaled = options;
  scaled.regularisation_weight *= factor;
  scaled.rest_weight *= factor;
  return scaled;
}

}  // namespace softscope
