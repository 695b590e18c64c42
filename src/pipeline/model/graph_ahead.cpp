#include "pipeline/model/graph_ahead.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "core/parallel_copy.h"
#include "deform/graph/graph_builder.h"
#include "deform/graph/graph_copy.h"

namespace softscope {
namespace {

constexpr double kFewUnbound = 0.01;  // of the points: these can follow their neighbours once

bool isFew(const std::vector<PointBinding>& bindings) {
  return static_cast<double>(unboundPoints(bindings).size()) <=
         kFewUnbound * static_cast<double>(bindings.size());
}

/// Calls `work`, then fulfils `done`.
template <class Work>
void workFor(std::promise<void>* done, const Work& work) {
  try {
    work();
    done->set_value();
  } catch (...) {
    done->set_exception(std::current_exception());
  }
}

}  // namespace

void GraphAhead::prepare(const GraphOptions& options, const PointModel& model,
                         const WarpGraph& graph, DeformSolver* solver) {
  drop();
  can_wait_ = isFew(model.bindings);
  std::promise<void> grown, prepared;
  growth_ = grown.get_future();
  solver_ = prepared.get_future();
  thread_ = std::async(
      std::launch::async, [this, options, &model, &graph, solver, grown = std::move(grown),
                           prepared = std::move(prepared)]() mutable {
        // Copied first: its transforms change once the solver is prepared.
        copyGraph(graph, &grown_.graph);
        if (can_wait_) copyStructure(graph, &analysed_);
        const auto grow = [&] {
          workFor(&grown, [&] {
            parallelCopy(model.bindings, &grown_.bindings);
            growGraph(options, model.positions_mm, &grown_.bindings, &grown_.graph);
            if (!can_wait_) copyStructure(grown_.graph, &analysed_);
          });
        };
        const auto prepareSolver = [&] { workFor(&prepared, [&] { solver->prepare(analysed_); }); };
        if (can_wait_) return parallelInvoke(grow, prepareSolver);
        grow();
        prepareSolver();
      });
}

bool GraphAhead::canWait(const PointModel& model) const {
  return growth_.valid() ? can_wait_ : isFew(model.bindings);
}

void GraphAhead::grow(const GraphOptions& options, PointModel* model, WarpGraph* graph) {
  std::vector<NodeTransform> found = graph->transforms;
  if (growth_.valid()) {
    growth_.get();
    std::swap(model->bindings, grown_.bindings);
    std::swap(*graph, grown_.graph);
    std::swap(graph->afar, grown_.graph.afar);  // may have been chosen since the copy
  } else {
    growGraph(options, model, graph);
  }
  followNeighbours(std::move(found), graph);
}

void GraphAhead::waitForSolver() {
  if (solver_.valid()) solver_.get();
}

void GraphAhead::drop() {
  if (thread_.valid()) thread_.wait();
  thread_ = {};
  growth_ = {};
  solver_ = {};
}

}  // namespace softscope
