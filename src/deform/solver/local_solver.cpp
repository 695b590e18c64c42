#include "deform/solver/local_solver.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "deform/solver/local_graph.h"

namespace softscope {
namespace {

bool isLocal(const WarpGraph& graph) {
  return std::find(graph.afar.begin(), graph.afar.end(), 1) != graph.afar.end();
}

/// Per node, 1 if it carries a visible point or a match.
std::vector<char> nodesInSight(const PointModel& model, const DeformObservation& seen,
                               const WarpGraph& graph) {
  std::vector<char> stencils(graph.stencils.size(), 0), nodes(graph.size(), 0);
  const auto mark = [&](std::int32_t point) {
    const PointBinding& binding = model.bindings[static_cast<std::size_t>(point)];
    if (binding.bound()) stencils[static_cast<std::size_t>(binding.stencil)] = 1;
  };
  for (const int point : *seen.visible) mark(point);
  for (const KeyPointMatch& match : seen.matches) mark(match.model_point);
  for (std::size_t s = 0; s < stencils.size(); ++s)
    if (stencils[s] != 0)
      for (const std::int32_t node : graph.stencils[s]) nodes[static_cast<std::size_t>(node)] = 1;
  return nodes;
}

class LocalSolver final : public DeformSolver {
 public:
  LocalSolver(std::unique_ptr<DeformSolver> whole, double node_spacing_mm)
      : whole_(std::move(whole)), node_spacing_mm_(node_spacing_mm) {}

  NodeModel nodeModel() const override { return whole_->nodeModel(); }

  void prepare(const WarpGraph& graph) override {
    if (!mayBeLocal(graph)) return whole_->prepare(graph);
    if (graph.afar.empty()) return;  // the first choice follows from what will be seen
    if (!isLocal(graph)) return whole_->prepare(graph);
    local_.take(graph);
    parallelInvoke([&] { whole_->prepare(local_.graph()); }, [&] { local_.prepareReturn(graph); });
  }

  DeformSummary solve(const PointModel& model, const DeformObservation& seen,
                      WarpGraph* graph) override {
    if (mayBeLocal(*graph) && seen.visible != nullptr)
      chooseNodes(nodesInSight(model, seen, *graph), graph);
    else
      graph->afar.clear();
    if (!isLocal(*graph)) return whole_->solve(model, seen, graph);
    local_.take(*graph);
    const DeformSummary summary = whole_->solve(model, seen, &local_.graph());
    local_.returnTo(graph);
    return summary;
  }

 private:
  static bool mayBeLocal(const WarpGraph& graph) { return graph.size() > LocalRule::kWholeUpTo; }

  void chooseNodes(const std::vector<char>& in_sight, WarpGraph* graph) {
    const bool chosen_before = !graph->afar.empty();
    graph->afar.resize(graph->size(), 0);  // new nodes lie beside visible tissue
    if (std::find(in_sight.begin(), in_sight.end(), 1) == in_sight.end()) return;
    const std::vector<double> away_mm = distancesFrom(in_sight, *graph, local_.neighboursIn(*graph),
                                                      LocalRule::kMost * node_spacing_mm_);
    const auto within = [&](std::size_t j, double spacings) {
      return away_mm[j] <= spacings * node_spacing_mm_;
    };
    bool keeps = chosen_before;
    for (std::size_t j = 0; keeps && j < graph->size(); ++j)
      keeps = graph->afar[j] == 0 ? within(j, LocalRule::kMost) : !within(j, LocalRule::kLeast);
    if (keeps) return;
    for (std::size_t j = 0; j < graph->size(); ++j) graph->afar[j] = !within(j, LocalRule::kChosen);
  }

  std::unique_ptr<DeformSolver> whole_;
  double node_spacing_mm_;
  LocalGraph local_;
};

}  // namespace

std::unique_ptr<DeformSolver> makeLocalSolver(std::unique_ptr<DeformSolver> whole,
                                              double node_spacing_mm) {
  return std::make_unique<LocalSolver>(std::move(whole), node_spacing_mm);
}

}  // namespace softscope
