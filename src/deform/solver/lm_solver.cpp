#include "deform/solver/lm_solver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "deform/energy/graph_facts.h"
#include "deform/solver/cpu_warp_system.h"

namespace softscope {
namespace {

// What a first step leaves above this share of the cost is noise: docs/energy.md after (19).
constexpr double kNoiseShare = 0.5;
constexpr double kSuspiciousPivotRatio = 3e-4;  // tissue with data has 0.01 and more

double meanDataResidual(const EnergySums& energy, int points) {
  return points > 0 ? energy.data_abs_sum_mm / points : 0;
}

/// By how much, as a share of the cost, all further steps together reduce it, if the gains of steps
/// go on to shrink as the last two did; the last gain, if there is one alone. `costs` before and
/// after each step.
double gainToCome(const std::vector<double>& costs) {
  const auto gain = [&](std::size_t end) {
    return (costs[end - 2] - costs[end - 1]) / costs[end - 2];
  };
  const double last = gain(costs.size());
  if (costs.size() < 4) return last;
  const double shrinks = last / gain(costs.size() - 2);
  return shrinks < 0.5 ? last * shrinks / (1 - shrinks) : last;
}

/// Whether the only step so far is enough.
bool leavesNoise(const std::vector<double>& costs) {
  return costs.size() == 2 && costs[1] > kNoiseShare * costs[0];
}

class WarpSolver final : public DeformSolver {
 public:
  WarpSolver(const DeformOptions& options, std::unique_ptr<WarpSystem> system)
      : options_(options), system_(std::move(system)) {}

  NodeModel nodeModel() const override { return options_.node_model; }
  void prepare(const WarpGraph& graph) override { system_->analyse(graph); }

  DeformSummary solve(const PointModel& model, const DeformObservation& seen,
                      WarpGraph* graph) override {
    DeformSummary summary;
    if (graph->empty()) return summary;
    if (!allFinite(*graph)) {
      summary.reason = StopReason::kNotFinite;
      summary.warnings.push_back("the graph holds positions or transforms that are not finite");
      return summary;
    }
    after_gap_ = seen.after_gap;
    const MatchCounts matches = system_->begin(model, seen, *graph);
    summary.matches = matches.used;
    summary.matches_dropped = matches.dropped;
    iterate(*graph, &summary);
    std::vector<NodeTransform> found = system_->transforms();
    std::swap(graph->transforms, found);
    if (!allFinite(*graph)) {
      std::swap(graph->transforms, found);
      summary.reason = StopReason::kNotFinite;
    }
    summary.times = system_->times();
    return summary;
  }

 private:
  enum class Step { kAccepted, kConverged, kNone };

  void iterate(const WarpGraph& graph, DeformSummary* summary) {
    const SolverOptions& rules = options_.solver;
    damping_ = rules.kInitialDamping;
    summary->reason = StopReason::kIterationLimit;
    while (summary->iterations < rules.max_iterations) {
      if (summary->iterations % rules.kIterationsPerAssociation == 0) {
        if (!reassociate(graph, summary)) {
          summary->reason = StopReason::kNothingToFit;
          break;
        }
      }
      const Step step = stepDown(summary);
      if (step == Step::kAccepted) continue;
      summary->reason =
          step == Step::kConverged ? StopReason::kConverged : StopReason::kNoBetterStep;
      break;
    }
    summary->after = current_.terms;
    summary->points_after = points_;
    summary->data_mean_mm_after = meanDataResidual(current_, points_);
    summary->damping = damping_;
    describeCondition(summary);
  }

  /// Both pivots are square roots.
  void describeCondition(DeformSummary* summary) const {
    if (summary->iterations == 0) return;
    summary->pivot_ratio = system_->pivotRatio();
    if (summary->pivot_ratio > kSuspiciousPivotRatio) return;
    std::ostringstream text;
    text << "ill-conditioned: pivots differ by a factor of " << 1 / summary->pivot_ratio
         << "; some nodes are held by damping alone";
    summary->warnings.push_back(text.str());
  }

  /// Returns false without any constraint.
  bool reassociate(const WarpGraph& graph, DeformSummary* summary) {
    const AssociatedEnergy associated = system_->associate();
    current_ = associated.energy;
    points_ = associated.points;
    if (summary->iterations == 0) describeStart(graph, summary);
    return associated.constrained;
  }

  void describeStart(const WarpGraph& graph, DeformSummary* summary) const {
    summary->before = current_.terms;
    summary->points_before = points_;
    summary->data_mean_mm_before = meanDataResidual(current_, points_);
    const std::vector<char> pulled = system_->constrainedNodes();
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

  /// One accepted step, or the reason for none: docs/energy.md (16) to (19).
  Step stepDown(DeformSummary* summary) {
    system_->assemble();
    double growth = 2;
    for (int attempt = 0; attempt < options_.solver.kMaxRejections; ++attempt) {
      if (const std::optional<TrialStep> trial = system_->tryStep(damping_)) {
        if (trial->predicted_decrease <= 1e-13 * current_.terms.total()) return Step::kConverged;
        const double decrease = current_.terms.total() - trial->energy.terms.total();
        if (std::isfinite(trial->energy.terms.total()) && decrease > 0) {
          relax(decrease / trial->predicted_decrease);
          return accept(*trial, attempt == 0, summary);
        }
      }
      ++summary->rejections;
      damping_ *= growth;
      growth *= 2;
      if (damping_ > options_.solver.kMaxDamping) break;
    }
    damping_ = std::min(damping_, options_.solver.kMaxDamping);
    return Step::kNone;
  }

  /// docs/energy.md (19).
  void relax(double gain) {
    const double factor = std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
    damping_ =
        std::clamp(damping_ * factor, options_.solver.kMinDamping, options_.solver.kMaxDamping);
  }

  /// A step that is small because of damping does not indicate convergence.
  Step accept(const TrialStep& trial, bool undoubted, DeformSummary* summary) {
    summary->costs.push_back(current_.terms.total());
    summary->costs.push_back(trial.energy.terms.total());
    system_->acceptStep();
    current_ = trial.energy;
    ++summary->iterations;
    summary->last_step_mm = trial.furthest_mm;
    const bool small_step = summary->last_step_mm < options_.solver.step_tolerance_mm;
    const bool small_gain = gainToCome(summary->costs) < options_.solver.cost_tolerance;
    const bool is_enough = small_step || small_gain || (!after_gap_ && leavesNoise(summary->costs));
    return undoubted && is_enough ? Step::kConverged : Step::kAccepted;
  }

  DeformOptions options_;
  std::unique_ptr<WarpSystem> system_;
  EnergySums current_;
  int points_ = 0;
  double damping_ = 0;
  bool after_gap_ = false;
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
  return makeDeformSolver(options, makeCpuWarpSystem(options));
}

std::unique_ptr<DeformSolver> makeDeformSolver(const DeformOptions& options,
                                               std::unique_ptr<WarpSystem> system) {
  options.validate();
  return std::make_unique<WarpSolver>(options, std::move(system));
}

}  // namespace softscope
