#include "fusion/innovation.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "fusion/fusion_weights.h"

namespace softscope {
namespace {

/// A node that few points speak for is believed to be like the whole frame: that counts as so many.
constexpr double kPriorPoints = 5;

/// A difference counts as no more than so many standard deviations of those around it: single wrong
/// depths say nothing about the tissue.
constexpr double kLargest = 3;
const double kGaussian = std::sqrt(M_PI / 2);  // standard deviation over mean absolute value

bool carries(const WarpGraph& graph, const PointBinding& binding) {
  return binding.bound() && binding.stencil < static_cast<std::int32_t>(graph.stencils.size());
}

/// One seen point: who carries it, and how it differs from the measurement.
struct Difference {
  const NodeStencil* stencil;
  const PointBinding* binding;
  double weight;  // of the measurement
  double away_mm;
  double sigma_mm;  // of the depth
};

std::vector<Difference> differences(const PointModel& model, const WarpGraph& graph,
                                    const DepthMap& depth, const Visibility& visibility,
                                    const PointFusionOptions& options) {
  const float reference_mm = static_cast<float>(options.reference_sigma_mm),
              largest = static_cast<float>(options.max_measurement_weight);
  std::vector<Difference> found;
  found.reserve(model.size());
  for (std::size_t i = 0; i < model.size(); ++i) {
    const PointSight& point = visibility.points[i];
    const PointBinding& binding = model.bindings[i];
    if (point.sight != Sight::kSeen || !carries(graph, binding)) continue;
    const float sigma_mm = depth.sigma_mm.values[static_cast<std::size_t>(point.pixel)];
    found.push_back({&graph.stencils[static_cast<std::size_t>(binding.stencil)], &binding,
                     depthWeight(sigma_mm, reference_mm, largest), std::abs(point.ahead_mm),
                     sigma_mm});
  }
  return found;
}

/// The mean of some quantity around each node.
template <class Quantity>
std::vector<double> nodeMeans(const std::vector<Difference>& all, std::size_t nodes,
                              const Quantity& quantity) {
  double frame_weight = 0, frame_total = 0;
  std::vector<double> weights(nodes), totals(nodes);
  for (const Difference& one : all) {
    const double value = quantity(one);
    frame_weight += one.weight, frame_total += one.weight * value;
    for (int k = 0; k < kNodesPerPoint; ++k) {
      const std::size_t node = static_cast<std::size_t>((*one.stencil)[k]);
      const double share = one.weight * one.binding->weights[k];
      weights[node] += share, totals[node] += share * value;
    }
  }
  const double prior = kPriorPoints * frame_total / frame_weight;
  for (std::size_t n = 0; n < nodes; ++n)
    totals[n] = (totals[n] + prior) / (weights[n] + kPriorPoints);
  return totals;
}

}  // namespace

InnovationField::InnovationField(const PointModel& model, const WarpGraph& graph,
                                 const Observation& observation, const Visibility& visibility,
                                 const PointFusionOptions& options) {
  if (observation.depth.sigma_mm.empty() || !(options.reference_sigma_mm > 0)) return;
  const std::vector<Difference> all =
      differences(model, graph, observation.depth, visibility, options);
  if (all.empty()) return;
  std::vector<double> square_mm2, expected_mm2;
  const auto findSquares = [&] {
    const std::vector<double> away_mm =
        nodeMeans(all, graph.size(), [](const Difference& one) { return one.away_mm; });
    square_mm2 = nodeMeans(all, graph.size(), [&](const Difference& one) {
      double around_mm = 0;
      for (int k = 0; k < kNodesPerPoint; ++k)
        around_mm += one.binding->weights[k] * away_mm[static_cast<std::size_t>((*one.stencil)[k])];
      const double counted_mm = std::min(one.away_mm, kLargest * kGaussian * around_mm);
      return counted_mm * counted_mm;
    });
  };
  parallelInvoke(findSquares, [&] {
    expected_mm2 = nodeMeans(all, graph.size(),
                             [](const Difference& one) { return one.sigma_mm * one.sigma_mm; });
  });
  for (std::size_t n = 0; n < graph.size(); ++n)
    nodes_.push_back({static_cast<float>(square_mm2[n]),
                      static_cast<float>(std::max(0.0, square_mm2[n] - expected_mm2[n]))});
}

Innovation InnovationField::at(const WarpGraph& graph, const PointBinding& binding) const {
  Innovation here;
  if (nodes_.empty() || !carries(graph, binding)) return here;
  const NodeStencil& stencil = graph.stencils[static_cast<std::size_t>(binding.stencil)];
  for (int k = 0; k < kNodesPerPoint; ++k) {
    const Innovation& node = nodes_[static_cast<std::size_t>(stencil[k])];
    here.difference_mm2 += binding.weights[k] * node.difference_mm2;
    here.excess_mm2 += binding.weights[k] * node.excess_mm2;
  }
  return here;
}

}  // namespace softscope
