// cuda/warp/warp_passes.h: the order of the kernels of the warp's least-squares problem, for any
// executor.
#pragma once

#include <algorithm>

#include "cuda/device/ordered_list.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/warp/warp_fronts.h"
#include "cuda/warp/warp_nodes.h"
#include "cuda/warp/warp_points.h"
#include "cuda/warp/warp_stencils.h"

namespace softscope::cuda {

/// Inputs of the kernels besides the arrays.
struct WarpInputs {
  WarpWeights weights;
  DepthLookUp surface;  // pointers of the device
  int points = 0;
  float points_each = 1;
  double lever_mm = 1;
};

/// Damping of the diagonal: docs/energy.md (17).
struct WarpDamping {
  double relative = 0, floor = 0;
};

template <class Executor>
class WarpPasses {
 public:
  explicit WarpPasses(Executor& executor) : executor_(executor) {}

  /// The listed points of the model, by stencil, and the loads of the nodes.
  void listPoints(const WarpStructureLayout& graph, const SeenModel& of,
                  const PointListLayout& list, const WarpPointLayout& points) {
    constexpr std::size_t kWords = sizeof(FixedSum) / sizeof(std::uint32_t);
    const auto stencils = static_cast<std::size_t>(list.stencils);
    ResetKernel reset;
    reset.add(graph.point_start, stencils + 1, 0);
    reset.add(list.filled, stencils, 0);
    reset.add(list.shares, 2 * kNodesPerPoint * stencils * kWords, 0);
    reset.add(list.loads, 2 * static_cast<std::size_t>(list.nodes) * kWords, 0);
    reset.add(list.counts, sizeof(PointListCounts) / sizeof(std::uint32_t), 0);
    launch("reset", reset);
    launch("count points", CountPointsKernel{of, list, graph.point_start});
    executor_.launch(
        "list starts",
        ListStartsKernel{graph.point_start, list.stencils, graph.point_start + list.stencils},
        Grid{});
    launch("list points", ListPointsKernel{of, list, graph.point_start});
    launch("sort points", SortPointsKernel{of, list, graph.point_start, points});
    launch("load nodes", LoadNodesKernel{graph.stencil_nodes, list});
    executor_.mark("points");
  }

  /// Targets, normal equations and energy at these transforms.
  void linearise(const WarpStructureLayout& graph, const WarpPointLayout& points,
                 const WarpMatchLayout& matches, const WarpInputs& inputs,
                 const NodeTransform* transforms) {
    launch("pack nodes", PackNodesKernel{graph, transforms});
    launch("associate", AssociateKernel{graph, points, inputs.surface, inputs.points,
                                        inputs.points_each, inputs.weights.data});
    executor_.mark("associate");
    constexpr bool kAssembles = true;
    launch("stencils",
           StencilKernel<kAssembles>{graph, points, matches, transforms, inputs.weights});
    launch("edges", EdgeKernel<kAssembles>{graph, transforms, inputs.weights.regularisation});
    launch("gather", GatherKernel{graph, transforms, inputs.weights.rest});
    executor_.launch("sums", SumKernel{graph, /*with_step=*/false}, Grid{});
    executor_.mark("assemble");
  }

  void factor(const WarpStructureLayout& graph, const FrontTables& fronts, WarpDamping damping) {
    for (int level = 0; level < fronts.levels(); ++level) {
      const int first = fronts.level_start[level], count = fronts.level_start[level + 1] - first;
      executor_.launch(
          "assemble fronts", AssembleFrontsKernel{graph, first, damping.relative, damping.floor},
          Grid{blocksFor(fronts.level_rows[level], AssembleFrontsKernel::kThreads), count, 1});
      executor_.launch("factor fronts", FactorFrontsKernel{graph, first},
                       Grid{count, factorBlocks(fronts, level), 1});
      executor_.launch("update fronts", UpdateFrontsKernel{graph, first},
                       Grid{fronts.level_tiles[level], count, 1});
    }
    executor_.mark("factor");
  }

  /// After factor(): solution, resulting transforms, and their energy.
  void step(const WarpStructureLayout& graph, const FrontTables& fronts,
            const WarpPointLayout& points, const WarpMatchLayout& matches, const WarpInputs& inputs,
            double damping, const NodeTransform* transforms, NodeTransform* trial) {
    for (int level = fronts.levels() - 1; level >= 0; --level) {
      const int first = fronts.level_start[level], count = fronts.level_start[level + 1] - first;
      executor_.launch("solve fronts", SolveFrontsKernel{graph, first}, Grid{count, 1, 1});
    }
    executor_.mark("solve");
    launch("step", StepKernel{graph, transforms, trial, damping, inputs.lever_mm});
    constexpr bool kAssembles = false;
    launch("stencils", StencilKernel<kAssembles>{graph, points, matches, trial, inputs.weights});
    launch("edges", EdgeKernel<kAssembles>{graph, trial, inputs.weights.regularisation});
    executor_.launch("sums", SumKernel{graph, /*with_step=*/true}, Grid{});
    executor_.mark("trial");
  }

 private:
  /// The most of a front of the level.
  static int factorBlocks(const FrontTables& fronts, int level) {
    int most = 0;
    for (int i = fronts.level_start[level]; i < fronts.level_start[level + 1]; ++i)
      most = std::max(most, FactorFrontsKernel::blocks(fronts.fronts[static_cast<std::size_t>(i)]));
    return most;
  }
  template <class Kernel>
  void launch(const char* name, const Kernel& kernel) {
    executor_.launch(name, kernel, kernel.blocks());
  }

  Executor& executor_;
};

}  // namespace softscope::cuda
