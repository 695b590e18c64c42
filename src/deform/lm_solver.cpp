#include "deform/lm_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/parallel.h"
#include "deform/block_cholesky.h"
#include "deform/graph_facts.h"
#include "deform/node_sight.h"
#include "deform/node_terms.h"
#include "deform/normal_equations.h"
#include "deform/shape_memory.h"

namespace softscope {
namespace {

using Clock = std::chrono::steady_clock;

/// Adds the time until its end to one entry.
class Stopwatch {
 public:
  explicit Stopwatch(double* total_ms) : total_ms_(total_ms), start_(Clock::now()) {}
  ~Stopwatch() {
    *total_ms_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double* total_ms_;
  Clock::time_point start_;
};

constexpr double kSuspiciousPivotRatio = 3e-4;  // tissue with data has 0.01 and more

double meanDataResidual(const EnergyValue& value, int points) {
  return points > 0 ? value.data_abs_sum_mm / points : 0;
}

template <class Node>
class Solver : public DeformSolver {
 public:
  explicit Solver(const DeformOptions& options) : options_(options) {}

  NodeModel nodeModel() const override { return options_.node_model; }
  void prepare(const WarpGraph& graph) override {
    if (!graph.empty() && !structure_.sameAs(graph)) analyse(graph);
  }

  DeformSummary solve(const PointModel& model, const DeformObservation& seen,
                      WarpGraph* graph) override {
    DeformSummary summary;
    if (graph->empty()) return summary;
    if (!allFinite(*graph)) {
      summary.reason = StopReason::kNotFinite;
      summary.warnings.push_back("the graph holds positions or transforms that are not finite");
      return summary;
    }
    const std::vector<NodeTransform> initial = graph->transforms;
    prepare(model, seen, *graph, &summary);
    iterate(seen.surface, graph, &summary);
    if (!allFinite(*graph)) {
      graph->transforms = initial;
      summary.reason = StopReason::kNotFinite;
    }
    return summary;
  }

 private:
  enum class Step { kAccepted, kConverged, kNone };

  void prepare(const PointModel& model, const DeformObservation& seen, const WarpGraph& graph,
               DeformSummary* summary) {
    const Stopwatch watch(&summary->times.prepare_ms);
    prepare(graph);
    if (seen.surface != nullptr && options_.data_weight > 0)
      collectCandidates(model, graph, seen.visible, options_.association.max_points, &candidates_);
    else
      dropCandidates(graph);
    makeConstraints(model, graph, candidates_, seen.matches, options_.correspondence_weight,
                    &constraints_);
    judgeSight(model, graph, candidates_, options_.seen_stiffness, &constraints_);
    expectShape(graph, options_.shape_memory, &constraints_);
    summary->matches = constraints_.matches;
    summary->matches_dropped = constraints_.matches_dropped;
    lever_mm_ = meanEdgeLength(graph);
  }

  void analyse(const WarpGraph& graph) {
    const BlockPattern pattern = makeBlockPattern(graph);
    equations_.analyse(graph, pattern);
    if (!(pattern == pattern_)) cholesky_.analyse(pattern, Node::kUnknowns);
    pattern_ = pattern;
    structure_.take(graph);
  }

  void dropCandidates(const WarpGraph& graph) {
    candidates_ = CandidatePoints();
    candidates_.stencil_start.assign(graph.stencils.size() + 1, 0);
  }

  void iterate(const SurfaceTarget* surface, WarpGraph* graph, DeformSummary* summary) {
    const SolverOptions& rules = options_.solver;
    damping_ = rules.kInitialDamping;
    summary->reason = StopReason::kIterationLimit;
    while (summary->iterations < rules.max_iterations) {
      if (summary->iterations % rules.kIterationsPerAssociation == 0) {
        if (!reassociate(surface, *graph, summary)) {
          summary->reason = StopReason::kNothingToFit;
          break;
        }
      }
      const Step step = stepDown(graph, summary);
      if (step == Step::kAccepted) continue;
      summary->reason =
          step == Step::kConverged ? StopReason::kConverged : StopReason::kNoBetterStep;
      break;
    }
    summary->after = current_.terms;
    summary->points_after = constraints_.points;
    summary->data_mean_mm_after = meanDataResidual(current_, constraints_.points);
    summary->damping = damping_;
    describeCondition(summary);
  }

  /// Both pivots are square roots of what they stand for.
  void describeCondition(DeformSummary* summary) const {
    if (summary->iterations == 0) return;
    summary->pivot_ratio = cholesky_.pivotRatio();
    if (summary->pivot_ratio > kSuspiciousPivotRatio) return;
    std::ostringstream text;
    text << "ill-conditioned: pivots differ by a factor of " << 1 / summary->pivot_ratio
         << "; some nodes are held by damping alone";
    summary->warnings.push_back(text.str());
  }

  /// Returns false where nothing pulls at all.
  bool reassociate(const SurfaceTarget* surface, const WarpGraph& graph, DeformSummary* summary) {
    {
      const Stopwatch watch(&summary->times.associate_ms);
      associate(graph, candidates_, surface, options_.data_weight, &constraints_);
    }
    evaluate(graph, &current_, summary);
    if (summary->iterations == 0) describeStart(graph, summary);
    return !constraints_.active.empty();
  }

  void describeStart(const WarpGraph& graph, DeformSummary* summary) const {
    summary->before = current_.terms;
    summary->points_before = constraints_.points;
    summary->data_mean_mm_before = meanDataResidual(current_, constraints_.points);
    const std::vector<char> pulled = nodesWithData(graph, constraints_);
    summary->nodes_without_data =
        static_cast<int>(std::count(pulled.begin(), pulled.end(), char{0}));
    summary->components_without_data = countIdleComponents(graph, pulled);
    if (summary->components_without_data > 0) {
      std::ostringstream text;
      text << summary->components_without_data
           << " connected parts of the graph have neither points nor matches: they stay";
      summary->warnings.push_back(text.str());
    }
  }

  void evaluate(const WarpGraph& graph, EnergyValue* value, DeformSummary* summary) const {
    const Stopwatch watch(&summary->times.evaluate_ms);
    evaluateEnergy(graph, constraints_, options_, value);
  }

  /// One accepted step, or the reason why there is none: docs/energy.md (16) to (19).
  Step stepDown(WarpGraph* graph, DeformSummary* summary) {
    {
      const Stopwatch watch(&summary->times.assemble_ms);
      equations_.assemble(*graph, constraints_, current_, options_);
    }
    const std::vector<NodeTransform> start = graph->transforms;
    double growth = 2;
    for (int attempt = 0; attempt < options_.solver.kMaxRejections; ++attempt) {
      Eigen::VectorXd step;
      if (findStep(&step, summary)) {
        const double predicted = predictedDecrease(step);
        if (predicted <= 1e-13 * current_.terms.total()) return Step::kConverged;
        applyStep(step, start, graph);
        evaluate(*graph, &trial_, summary);
        const double decrease = current_.terms.total() - trial_.terms.total();
        if (std::isfinite(trial_.terms.total()) && decrease > 0) {
          relax(decrease / predicted);
          return accept(step, decrease, attempt == 0, summary);
        }
        graph->transforms = start;
      }
      ++summary->rejections;
      damping_ *= growth;
      growth *= 2;
      if (damping_ > options_.solver.kMaxDamping) break;
    }
    damping_ = std::min(damping_, options_.solver.kMaxDamping);
    return Step::kNone;
  }

  /// (H + lambda D) step = -g: docs/energy.md (17).
  bool findStep(Eigen::VectorXd* step, DeformSummary* summary) {
    const Stopwatch watch(&summary->times.factor_ms);
    const double floor = 1e-10 * equations_.largestDiagonal();
    if (!(floor > 0)) return false;
    if (!cholesky_.factor(equations_.blocks(), {damping_, floor})) return false;
    *step = -cholesky_.solve(equations_.gradient());
    return step->allFinite();
  }

  /// docs/energy.md (18).
  double predictedDecrease(const Eigen::VectorXd& step) const {
    return -step.dot(equations_.gradient()) + damping_ * equations_.diagonalProduct(step);
  }

  void applyStep(const Eigen::VectorXd& step, const std::vector<NodeTransform>& start,
                 WarpGraph* graph) const {
    for (std::size_t j = 0; j < graph->size(); ++j) {
      graph->transforms[j] = start[j];
      Node::apply(step.data() + j * Node::kUnknowns, &graph->transforms[j]);
    }
  }

  /// docs/energy.md (19).
  void relax(double gain) {
    const double factor = std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
    damping_ =
        std::clamp(damping_ * factor, options_.solver.kMinDamping, options_.solver.kMaxDamping);
  }

  /// A step that is small only because it was damped is no sign of convergence.
  Step accept(const Eigen::VectorXd& step, double decrease, bool undoubted,
              DeformSummary* summary) {
    const double cost = current_.terms.total();
    summary->costs.push_back(cost);
    summary->costs.push_back(trial_.terms.total());
    std::swap(current_, trial_);
    ++summary->iterations;
    summary->last_step_mm = furthest(step);
    const bool small_step = summary->last_step_mm < options_.solver.step_tolerance_mm;
    const bool small_gain = decrease < options_.solver.cost_tolerance * cost;
    return undoubted && (small_step || small_gain) ? Step::kConverged : Step::kAccepted;
  }

  /// How far the step moves a node, or a point one edge away from it.
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
  CandidatePoints candidates_;
  ConstraintSet constraints_;
  EnergyValue current_, trial_;
  double damping_ = 0;
  double lever_mm_ = 1;
};

}  // namespace

const char* toString(StopReason reason) {
  switch (reason) {
    case StopReason::kConverged:
      return "converged";
    case StopReason::kIterationLimit:
      return "iteration limit";
    case StopReason::kNoBetterStep:
      return "no better step";
    case StopReason::kNothingToFit:
      return "nothing to fit";
    case StopReason::kNotFinite:
      return "not finite";
  }
  return "unknown";
}

std::unique_ptr<DeformSolver> makeDeformSolver(const DeformOptions& options) {
  options.validate();
  if (options.node_model == NodeModel::kRigid) return std::make_unique<Solver<RigidNode>>(options);
  return std::make_unique<Solver<AffineNode>>(options);
}

}  // namespace softscope
