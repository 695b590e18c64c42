#include "deform/solver/device_warp_system.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "deform/energy/graph_facts.h"
#include "deform/energy/node_sight.h"
#include "deform/energy/stiffness.h"
#include "deform/graph/shape_memory.h"
#include "deform/solver/stopwatch.h"

namespace softscope {
namespace {

WarpMatch warpMatch(const KeyPointMatch& match, const PointModel& model) {
  WarpMatch packed;
  Eigen::Map<Eigen::Vector3f>(packed.source) = match.source_mm;
  Eigen::Map<Eigen::Vector3f>(packed.target) = match.target_mm;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(packed.sqrt_information) =
      match.sqrt_information;
  const PointBinding& binding = model.bindings[static_cast<std::size_t>(match.model_point)];
  std::copy(binding.weights.begin(), binding.weights.end(), packed.node_weights);
  return packed;
}

class DeviceWarpSystem final : public WarpSystem {
 public:
  DeviceWarpSystem(const DeformOptions& options, std::unique_ptr<WarpDevice> device)
      : options_(options), device_(std::move(device)) {}

  void analyse(const WarpGraph& graph) override {
    if (graph.empty() || structure_.sameAs(graph)) return;
    device_->setStructure(makeWarpStructure(graph));
    structure_.take(graph);
  }

  MatchCounts begin(const PointModel& model, const DeformObservation& seen,
                    const WarpGraph& graph) override {
    times_ = DeformTimes();
    const Stopwatch watch(&times_.prepare_ms);
    analyse(graph);
    graph_ = &graph;
    const CarriedMatches carried(model, graph, seen.matches);
    NodeLoads loads;
    double stiffness = 1;
    // Independent.
    parallelInvoke(
        [&] {
          parallelInvoke([&] { takeMatches(model, carried); },
                         [&] { loads = takePoints(model, seen); });
        },
        [&] { stiffness = tissueStiffness(options_, graph, carried); });
    constraints_.stiffness.assign(graph.edges.size(), stiffness);
    device_->setSurface(surfaceOf(seen));
    takeNodes(loads);
    return {constraints_.matches, constraints_.matches_dropped};
  }

  /// The device assembles the normal equations with the energy.
  AssociatedEnergy associate() override {
    const Stopwatch watch(&times_.associate_ms);
    const WarpSums sums = device_->linearise();
    largest_diagonal_ = sums.largest_diagonal;
    const int points = static_cast<int>(sums.points);
    return {energyOf(sums), points, points > 0 || constraints_.matches > 0};
  }
  void assemble() override {}

  std::vector<char> constrainedNodes() override {
    const std::vector<int> targets = device_->targetCounts();
    for (std::size_t s = 0; s < targets.size(); ++s) constraints_.stencils[s].points = targets[s];
    listActive(&constraints_);
    return nodesWithData(*graph_, constraints_);
  }

  std::optional<TrialStep> tryStep(double damping) override {
    const Stopwatch watch(&times_.factor_ms);
    if (!(largest_diagonal_ > 0)) return std::nullopt;
    const WarpSums sums = device_->tryStep(damping);
    if (sums.failures > 0) return std::nullopt;
    pivot_ratio_ = sums.least_inverse_pivot / sums.largest_inverse_pivot;
    return TrialStep{sums.predicted_decrease, sums.furthest_mm, energyOf(sums)};
  }

  void acceptStep() override { device_->acceptStep(); }
  double pivotRatio() override { return pivot_ratio_; }
  std::vector<NodeTransform> transforms() override { return device_->transforms(); }
  DeformTimes times() const override { return times_; }

 private:
  DepthLookUp surfaceOf(const DeformObservation& seen) const {
    if (!usesSurface(seen)) return {};
    const auto* depth = dynamic_cast<const DepthTarget*>(seen.surface);
    if (depth == nullptr) throw Error("the device takes its targets from a DepthTarget alone");
    return depth->formula();
  }

  NodeLoads takePoints(const PointModel& model, const DeformObservation& seen) {
    const bool takes_all = options_.association.max_points == 0;
    if (takes_all && usesSurface(seen) && seen.visible != nullptr)
      if (std::optional<NodeLoads> loads = device_->setSeenPoints(model)) return *loads;
    NodeLoads loads;
    parallelInvoke([&] { loads.all = carriedPoints(model.bindings, *graph_, 1); },
                   [&] { loads.seen = sendPoints(model, seen); });
    return loads;
  }

  bool usesSurface(const DeformObservation& seen) const {
    return seen.surface != nullptr && options_.data_weight > 0;
  }

  /// Returns how many a node carries.
  std::vector<double> sendPoints(const PointModel& model, const DeformObservation& seen) {
    if (usesSurface(seen))
      collectCandidates(model, *graph_, seen.visible, options_.association.max_points,
                        &candidates_);
    else
      candidates_ = noCandidates(*graph_);
    WarpPoints points;
    points.count = static_cast<int>(candidates_.bindings.size());
    points.positions_mm = candidates_.positions_mm.data();
    points.normals = candidates_.normals.data();
    points.bindings = candidates_.bindings.data();
    points.start = candidates_.stencil_start.data();
    points.points_each = candidates_.points_each;
    std::vector<double> carried;
    parallelInvoke(
        [&] { device_->setPoints(points); },
        [&] { carried = carriedPoints(candidates_.bindings, *graph_, candidates_.points_each); });
    return carried;
  }

  /// The constraints contain no rows: the device creates them.
  void takeMatches(const PointModel& model, const CarriedMatches& carried) {
    const std::vector<KeyPointMatch>& matches = carried.matches;
    device_->setMatches(carried.count(), [&](const WarpMatches& room) {
      std::copy(carried.start.begin(), carried.start.end(), room.start);
      parallelRanges(static_cast<int>(matches.size()), kMatchesPerTask, [&](int begin, int end) {
        for (int i = begin; i < end; ++i)
          if (carried.place[i] >= 0) room.matches[carried.place[i]] = warpMatch(matches[i], model);
      });
    });
    countMatches(carried, *graph_, &constraints_);
    expectShape(*graph_, options_.shape_memory, &constraints_.expected);
  }

  void takeNodes(const NodeLoads& loads) {
    classifyNodes(*graph_, loads.all, loads.seen, options_.seen_stiffness, &constraints_);
    std::vector<double> edge_weights;
    edge_weights.reserve(graph_->edges.size());
    for (std::size_t e = 0; e < graph_->edges.size(); ++e)
      edge_weights.push_back(constraints_.stiffness[e] * graph_->edges[e].weight);
    device_->setNodes({graph_->positions_mm.data(), graph_->transforms.data(),
                       constraints_.hidden.data(), edge_weights.data(),
                       constraints_.expected.data(), meanEdgeLength(*graph_)});
  }

  EnergySums energyOf(const WarpSums& sums) const {
    EnergySums energy;
    energy.terms.regularisation = options_.regularisation_weight * sums.edges;
    energy.terms.rest = options_.rest_weight * sums.rest;
    energy.terms.data = sums.data;
    energy.terms.correspondence = sums.correspondence;
    energy.data_abs_sum_mm = sums.data_abs_mm;
    return energy;
  }

  DeformOptions options_;
  std::unique_ptr<WarpDevice> device_;
  GraphStructure structure_;
  const WarpGraph* graph_ = nullptr;  // of the frame at hand
  CandidatePoints candidates_;
  ConstraintSet constraints_;  // matches, and constraints of edges and nodes
  double largest_diagonal_ = 0, pivot_ratio_ = 1;
  DeformTimes times_;
};

}  // namespace

std::unique_ptr<WarpSystem> makeDeviceWarpSystem(const DeformOptions& options,
                                                 std::unique_ptr<WarpDevice> device) {
  require(options.node_model == NodeModel::kRigid, "deform.node_model", "affine",
          "a device takes rigid nodes alone");
  return std::make_unique<DeviceWarpSystem>(options, std::move(device));
}

}  // namespace softscope
