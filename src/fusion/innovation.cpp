#include "fusion/innovation.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "fusion/fusion_weights.h"

namespace softscope {
namespace {

constexpr int kNodesPerTask = 48;

bool carries(const WarpGraph& graph, const PointBinding& binding) {
  return isCarried(binding, static_cast<std::int32_t>(graph.stencils.size()));
}

/// Visible point: its binding, and its difference from the measurement.
struct Difference {
  const NodeStencil* stencil;
  const PointBinding* binding;
  double weight;  // of the measurement
  double away_mm;
  double sigma_mm;  // of the depth
};

/// In the order of the points.
std::vector<Difference> differences(const PointModel& model, const WarpGraph& graph,
                                    const DepthMap& depth, const Visibility& visibility,
                                    const PointFusionOptions& options) {
  const float reference_mm = static_cast<float>(options.reference_sigma_mm),
              largest = static_cast<float>(options.max_measurement_weight);
  const auto seenOf = [&](std::size_t i, std::vector<Difference>* found) {
    const PointSight& point = visibility.points[i];
    const PointBinding& binding = model.bindings[i];
    if (point.sight != Sight::kSeen || !carries(graph, binding)) return;
    const float sigma_mm = depth.sigma_mm.values[static_cast<std::size_t>(point.pixel)];
    found->push_back({&graph.stencils[static_cast<std::size_t>(binding.stencil)], &binding,
                      depthWeight(sigma_mm, reference_mm, largest), std::abs(point.ahead_mm),
                      sigma_mm});
  };
  const std::size_t grain = kPointsPerTask, tasks = (model.size() + grain - 1) / grain;
  std::vector<std::vector<Difference>> parts(tasks);
  parallelRanges(static_cast<int>(tasks), 1, [&](int begin, int end) {
    for (std::size_t task = static_cast<std::size_t>(begin); task < static_cast<std::size_t>(end);
         ++task) {
      parts[task].reserve(grain);
      for (std::size_t i = task * grain; i < std::min(model.size(), (task + 1) * grain); ++i)
        seenOf(i, &parts[task]);
    }
  });
  std::vector<Difference> found;
  found.reserve(model.size());
  for (const std::vector<Difference>& part : parts)
    found.insert(found.end(), part.begin(), part.end());
  return found;
}

/// Mean of a quantity around each node. Every task visits all
/// differences and adds those of its own nodes, in order.
template <class Quantity>
std::vector<double> nodeMeans(const std::vector<Difference>& all, std::size_t nodes,
                              const Quantity& quantity) {
  std::vector<double> values(all.size()), weights(nodes), totals(nodes);
  parallelRanges(static_cast<int>(all.size()), kPointsPerTask, [&](int begin, int end) {
    for (std::size_t i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      values[i] = quantity(all[i]);
  });
  double frame_weight = 0, frame_total = 0;
  const auto addFrame = [&] {
    for (std::size_t i = 0; i < all.size(); ++i)
      frame_weight += all[i].weight, frame_total += all[i].weight * values[i];
  };
  parallelInvoke(addFrame, [&] {
    parallelRanges(static_cast<int>(nodes), kNodesPerTask, [&](int begin, int end) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        const NodeStencil& stencil = *all[i].stencil;  // ascending
        if (stencil.back() < begin || stencil.front() >= end) continue;
        for (int k = 0; k < kNodesPerPoint; ++k) {
          const std::int32_t node = stencil[k];
          if (node < begin || node >= end) continue;
          const double share = all[i].weight * all[i].binding->weights[k];
          weights[node] += share, totals[node] += share * values[i];
        }
      }
    });
  });
  for (std::size_t n = 0; n < nodes; ++n)
    totals[n] = innovationMean(totals[n], weights[n], frame_total, frame_weight);
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
      const double counted_mm = countedDifference(one.away_mm, around_mm);
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
  if (nodes_.empty() || !carries(graph, binding)) return {};
  return innovationAt(graph.stencils[static_cast<std::size_t>(binding.stencil)], binding,
                      nodes_.data());
}

}  // namespace softscope
