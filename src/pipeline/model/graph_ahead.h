// src/pipeline/model/graph_ahead.h: growth of the node graph in parallel to stages that do not need
// it.
#pragma once

#include <future>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/options/deform_options.h"
#include "deform/solver/lm_solver.h"

namespace softscope {

/// growGraph() with at most one growth in progress on a thread. Same results.
class GraphAhead {
 public:
  /// Starts growth on copies, and prepares the solver: for this graph if growth can wait,
  /// else for the grown one. Model and graph must live and be unchanged until grow() or
  /// drop(), but for the transforms of the nodes after waitForSolver(); and the solver
  /// unused until then.
  void prepare(const GraphOptions& options, const PointModel& model, const WarpGraph& graph,
               DeformSolver* solver);
  /// Whether the next warp may be found without the new points: they are few, and
  /// then follow their neighbours.
  bool canWait(const PointModel& model) const;
  /// Takes the growth started for this model and graph, or grows them now. Nodes keep their
  /// transforms and `afar`; new ones get the motion of the nearest.
  void grow(const GraphOptions& options, PointModel* model, WarpGraph* graph);
  /// Waits until the solver is prepared.
  void waitForSolver();
  /// Waits for the growth in progress and discards it.
  void drop();

 private:
  struct Grown {
    std::vector<PointBinding> bindings;
    WarpGraph graph;
  };
  Grown grown_;         // of growth_; otherwise memory to reuse
  WarpGraph analysed_;  // by the solver
  bool can_wait_ = false;
  std::future<void> growth_, solver_, thread_;  // the thread ends before its memory is destroyed
};

}  // namespace softscope
