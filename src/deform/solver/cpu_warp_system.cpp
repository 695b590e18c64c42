#include "deform/solver/cpu_warp_system.h"

#include <algorithm>
#include <utility>

#include "deform/cholesky/block_cholesky.h"
#include "deform/energy/graph_facts.h"
#include "deform/energy/node_sight.h"
#include "deform/energy/stiffness.h"
#include "deform/graph/shape_memory.h"
#include "deform/kernels/node_terms.h"
#include "deform/solver/normal_equations.h"
#include "deform/solver/stopwatch.h"

namespace softscope {
namespace {

template <class Node>
class CpuWarpSystem final : public WarpSystem {
 public:
  explicit CpuWarpSystem(const DeformOptions& options) : options_(options) {}

  void analyse(const WarpGraph& graph) override {
    if (graph.empty() || structure_.sameAs(graph)) return;
    const BlockPattern pattern = makeBlockPattern(graph);
    equations_.analyse(graph, pattern);
    if (!(pattern == pattern_)) cholesky_.analyse(pattern, Node::kUnknowns);
    pattern_ = pattern;
    structure_.take(graph);
  }

  MatchCounts begin(const PointModel& model, const DeformObservation& seen,
                    const WarpGraph& graph) override {
    times_ = DeformTimes();
    const Stopwatch watch(&times_.prepare_ms);
    analyse(graph);
    graph_ = graph;
    surface_ = seen.surface;
    if (surface_ != nullptr && options_.data_weight > 0)
      collectCandidates(model, graph, seen.visible, options_.association.max_points, &candidates_);
    else
      candidates_ = noCandidates(graph);
    const CarriedMatches carried(model, graph, seen.matches);
    makeConstraints(model, graph, candidates_, carried, options_.correspondence_weight,
                    &constraints_);
    constraints_.stiffness.assign(graph.edges.size(), tissueStiffness(options_, graph, carried));
    classifyNodes(model, graph, candidates_, options_.seen_stiffness, &constraints_);
    expectShape(graph, options_.shape_memory, &constraints_.expected);
    lever_mm_ = meanEdgeLength(graph);
    return {constraints_.matches, constraints_.matches_dropped};
  }

  AssociatedEnergy associate() override {
    {
      const Stopwatch watch(&times_.associate_ms);
      softscope::associate(graph_, candidates_, surface_, options_.data_weight, &constraints_);
    }
    evaluate(&current_);
    return {current_, constraints_.points, !constraints_.active.empty()};
  }

  std::vector<char> constrainedNodes() override { return nodesWithData(graph_, constraints_); }

  void assemble() override {
    const Stopwatch watch(&times_.assemble_ms);
    equations_.assemble(graph_, constraints_, current_, options_);
  }

  std::optional<TrialStep> tryStep(double damping) override {
    Eigen::VectorXd step;
    if (!findStep(damping, &step)) return std::nullopt;
    TrialStep trial;
    trial.predicted_decrease =
        -step.dot(equations_.gradient()) + damping * equations_.diagonalProduct(step);
    trial.furthest_mm = furthest(step);
    trial_transforms_ = graph_.transforms;
    for (std::size_t j = 0; j < graph_.size(); ++j)
      Node::apply(step.data() + j * Node::kUnknowns, &trial_transforms_[j]);
    std::swap(graph_.transforms, trial_transforms_);
    evaluate(&trial_);
    std::swap(graph_.transforms, trial_transforms_);
    trial.energy = trial_;
    return trial;
  }

  void acceptStep() override {
    std::swap(graph_.transforms, trial_transforms_);
    std::swap(current_, trial_);
  }

  double pivotRatio() override { return cholesky_.pivotRatio(); }
  std::vector<NodeTransform> transforms() override { return graph_.transforms; }
  DeformTimes times() const override { return times_; }

 private:
  void evaluate(EnergyValue* value) {
    const Stopwatch watch(&times_.evaluate_ms);
    evaluateEnergy(graph_, constraints_, options_, value);
  }

  bool findStep(double damping, Eigen::VectorXd* step) {
    const Stopwatch watch(&times_.factor_ms);
    const double floor = SolverOptions::kDiagonalFloor * equations_.largestDiagonal();
    if (!(floor > 0)) return false;
    if (!cholesky_.factor(equations_.blocks(), {damping, floor})) return false;
    *step = -cholesky_.solve(equations_.gradient());
    return step->allFinite();
  }

  double furthest(const Eigen::VectorXd& step) const {
    double largest = 0;
    for (Eigen::Index j = 0; j < step.size(); j += Node::kUnknowns) {
      const double turn = step.segment(j, Node::kUnknowns - 3).norm() * lever_mm_;
      const double shift = step.segment(j + Node::kUnknowns - 3, 3).norm();
      largest = std::max({largest, turn, shift});
    }
    return largest;
  }

  DeformOptions options_;
  GraphStructure structure_;
  BlockPattern pattern_;
  NormalEquations<Node> equations_;
  BlockCholesky cholesky_;
  WarpGraph graph_;  // with the accepted transforms
  const SurfaceTarget* surface_ = nullptr;
  CandidatePoints candidates_;
  ConstraintSet constraints_;
  EnergyValue current_, trial_;
  std::vector<NodeTransform> trial_transforms_;
  double lever_mm_ = 1;
  DeformTimes times_;
};

}  // namespace

std::unique_ptr<WarpSystem> makeCpuWarpSystem(const DeformOptions& options) {
  if (options.node_model == NodeModel::kRigid)
    return std::make_unique<CpuWarpSystem<RigidNode>>(options);
  return std::make_unique<CpuWarpSystem<AffineNode>>(options);
}

}  // namespace softscope
