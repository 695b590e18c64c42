#include "deform/energy/stiffness.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/median.h"
#include "deform/kernels/edge_system.h"

namespace softscope {
namespace {

constexpr std::size_t kFewest = 20;  // matches, edges; the median of so few is right to a quarter
constexpr double kStrainOfNoise = 0.25;  // mean square of edges of still tissue, in squares of the
                                         // median match
constexpr double kSoftening = 4;  // how fast stiffness falls with what noise does not explain
constexpr double kLeastStiffness = 1.0 / 64;
constexpr double kHidden = 0.5;  // nodes with more invisible points are

}  // namespace

std::vector<double> edgeEnergies(const WarpGraph& graph,
                                 const std::vector<NodeTransform>& transforms,
                                 const std::vector<ExpectedOffsets>& expected) {
  std::vector<double> energies;
  energies.reserve(graph.edges.size());
  const auto placed = [&](std::int32_t node) {
    const auto j = static_cast<std::size_t>(node);
    return PlacedNode{graph.positions_mm[j], transforms[j]};
  };
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    energies.push_back(
        edgeEnergy(placed(graph.edges[e].first), placed(graph.edges[e].second), expected[e]));
  return energies;
}

std::vector<double> squaresOfSeenEdges(const WarpGraph& graph, const std::vector<double>& energies,
                                       const ConstraintSet& constraints) {
  std::vector<double> squares_mm2;
  squares_mm2.reserve(graph.edges.size());
  const auto isHidden = [&](std::int32_t node) {
    return constraints.hidden[static_cast<std::size_t>(node)] >= kHidden;
  };
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    if (!isHidden(edge.first) && !isHidden(edge.second))
      squares_mm2.push_back(edge.weight * energies[e] / 2);
  }
  return squares_mm2;
}

double stiffnessAfter(const FirstFit& fit) {
  const std::size_t edges = fit.edges_square_mm2.size();
  if (fit.matches_mm.size() < kFewest || edges < kFewest) return 1;
  const double match_mm = medianOf(fit.matches_mm);
  const double square_mm2 =
      std::accumulate(fit.edges_square_mm2.begin(), fit.edges_square_mm2.end(), 0.0) /
      static_cast<double>(edges);
  const double noise_mm2 = kStrainOfNoise * match_mm * match_mm;
  if (!(square_mm2 > noise_mm2)) return 1;
  if (!(noise_mm2 > 0)) return kLeastStiffness;
  return std::max(kLeastStiffness, 1 / (1 + kSoftening * (square_mm2 / noise_mm2 - 1)));
}

DeformOptions stiffer(const DeformOptions& options, double factor) {
  DeformOptions scaled = options;
  scaled.regularisation_weight *= factor;
  scaled.rest_weight *= factor;
  return scaled;
}

}  // namespace softscope
