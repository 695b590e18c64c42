// cuda/warp/warp_nodes.h: kernel bodies for edges, the sum of all parts, a step, and sums over a
// frame.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/warp/warp_layout.h"
#include "deform/kernels/node_terms.h"

namespace softscope::cuda {

/// One thread per edge: its energy and, if it assembles, its three blocks and two gradients.
template <bool kAssembles>
struct EdgeKernel {
  static constexpr int kThreads = 64, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  WarpStructureLayout graph;
  const NodeTransform* transforms;
  double weight;  // w_reg

  Grid blocks() const { return {blocksFor(graph.edges, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int e = at.x * kThreads + at.thread;
    if (e >= graph.edges) return;
    const PlacedNode first = nodeAt(graph.edge_nodes[2 * e]);
    const PlacedNode second = nodeAt(graph.edge_nodes[2 * e + 1]);
    graph.edge_energies[e] = edgeEnergy(first, second, graph.expected[e]);
    if constexpr (kAssembles) {
      const EdgeSystem<RigidNode> system(first, second, graph.expected[e],
                                         weight * graph.edge_weights[e]);
      double* to =
          graph.part_blocks + (static_cast<std::ptrdiff_t>(graph.stencils) * kStencilBlocks +
                               static_cast<std::ptrdiff_t>(e) * kEdgeBlocks) *
                                  kBlockEntries;
      for (int i = 0; i < kBlockEntries; ++i) {
        to[i] = system.first.data()[i];
        to[kBlockEntries + i] = system.cross.data()[i];
        to[2 * kBlockEntries + i] = system.second.data()[i];
      }
      double* slope = graph.part_gradients + (graph.stencils * kNodesPerPoint + 2 * e) * kUnknowns;
      for (int i = 0; i < kUnknowns; ++i) {
        slope[i] = system.first_gradient(i);
        slope[kUnknowns + i] = system.second_gradient(i);
      }
    }
  }

 private:
  SOFTSCOPE_HD PlacedNode nodeAt(int node) const { return {graph.rest_mm[node], transforms[node]}; }
};

/// One thread per entry of the matrix, then of the gradient:
/// its parts in a fixed order, and docs/energy.md (7b).
struct GatherKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  WarpStructureLayout graph;
  const NodeTransform* transforms;
  double rest_weight;

  Grid blocks() const {
    return {blocksFor(graph.blocks * kBlockEntries + graph.nodes * kUnknowns, kThreads), 1, 1};
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread, entries = graph.blocks * kBlockEntries;
    if (i < entries)
      gatherEntry(i);
    else if (i - entries < graph.nodes * kUnknowns)
      gatherSlope(i - entries);
  }

 private:
  SOFTSCOPE_HD void gatherEntry(int i) const {
    const int block = i / kBlockEntries, inside = i % kBlockEntries;
    double sum = 0;
    for (int p = graph.block_start[block]; p < graph.block_start[block + 1]; ++p)
      sum += graph.part_blocks[static_cast<std::ptrdiff_t>(graph.block_list[p]) * kBlockEntries +
                               inside];
    const int node = graph.diagonal_of[block], row = inside % kUnknowns;
    if (node >= 0 && row >= kUnknowns - 3 && row == inside / kUnknowns)
      sum += rest_weight * graph.hidden[node];
    graph.matrix[i] = sum;
  }
  SOFTSCOPE_HD void gatherSlope(int i) const {
    const int node = i / kUnknowns, row = i % kUnknowns;
    double sum = 0;
    for (int p = graph.gradient_start[node]; p < graph.gradient_start[node + 1]; ++p)
      sum += graph.part_gradients[graph.gradient_list[p] * kUnknowns + row];
    if (row >= kUnknowns - 3)
      sum +=
          rest_weight * graph.hidden[node] * transforms[node].translation_mm(row - (kUnknowns - 3));
    graph.gradient[i] = sum;
  }
};

/// One thread per block of the matrix; those of the diagonal compute step and trial of the node.
struct StepKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  WarpStructureLayout graph;
  const NodeTransform* transforms;
  NodeTransform* trial;
  double damping, lever_mm;

  Grid blocks() const { return {blocksFor(graph.blocks, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int block = at.x * kThreads + at.thread;
    if (block >= graph.blocks || graph.diagonal_of[block] < 0) return;
    const int node = graph.diagonal_of[block];
    const Vector6d step = -Eigen::Map<const Vector6d>(graph.solution + node * kUnknowns);
    const Eigen::Map<const Eigen::Matrix<double, kUnknowns, kUnknowns>> own(
        graph.matrix + static_cast<std::ptrdiff_t>(block) * kBlockEntries);
    const Eigen::Map<const Vector6d> slope(graph.gradient + node * kUnknowns);
    NodeStep out;
    double slope_part = 0, damped_part = 0;
    bool finite = true;
    for (int r = 0; r < kUnknowns; ++r) {
      double product = 0;
      for (int c = 0; c < kUnknowns; ++c) product += own(r, c) * step(c);
      slope_part += step(r) * slope(r);
      damped_part += step(r) * product;
      finite = finite && step(r) - step(r) == 0;
    }
    out.predicted_decrease = -slope_part + damping * damped_part;
    const double turn = step.head<3>().norm() * lever_mm, shift = step.tail<3>().norm();
    out.furthest_mm = turn > shift ? turn : shift;
    out.failures = finite ? 0 : 1;
    graph.steps[node] = out;
    NodeTransform moved = transforms[node];
    RigidNode::apply(step.data(), &moved);
    trial[node] = moved;
    graph.rest_energies[node] = graph.hidden[node] * moved.translation_mm.squaredNorm();
  }
};

/// One block: every sum of a frame in a fixed order.
struct SumKernel {
  static constexpr int kThreads = 256, kPhases = 3, kSums = 12, kParts = 16;
  struct Shared {
    double of_thread[kSums][kThreads];
    double of_part[kSums][kParts];
  };
  using Local = Nothing;
  WarpStructureLayout graph;
  bool with_step;  // else of the linearisation alone

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      double sums[kSums];
      for (int s = 0; s < kSums; ++s) sums[s] = startOf(s);
      sumThread(at.thread, sums);
      for (int s = 0; s < kSums; ++s) shared.of_thread[s][at.thread] = sums[s];
    } else if constexpr (kPhase == 1) {
      const int s = at.thread / kParts, part = at.thread % kParts;
      if (s >= kSums) return;
      constexpr int kEach = kThreads / kParts;
      double sum = startOf(s);
      for (int i = 0; i < kEach; ++i) sum = join(s, sum, shared.of_thread[s][part * kEach + i]);
      shared.of_part[s][part] = sum;
    } else if (at.thread < kSums) {
      double sum = startOf(at.thread);
      for (int i = 0; i < kParts; ++i) sum = join(at.thread, sum, shared.of_part[at.thread][i]);
      reinterpret_cast<double*>(graph.sums)[at.thread] = sum;
    }
  }

 private:
  static_assert(sizeof(WarpSums) == kSums * sizeof(double), "in the order of WarpSums");
  static constexpr int kDiagonal = 7, kFurthest = 8, kLeast = 9, kLargest = 10;
  SOFTSCOPE_HD static double startOf(int s) { return s == kLeast ? 1e300 : 0; }
  /// NaN counts as larger than any number.
  SOFTSCOPE_HD static double join(int s, double a, double b) {
    if (s == kLeast) return b < a ? b : a;
    if (s == kDiagonal || s == kFurthest || s == kLargest) return b <= a ? a : b;
    return a + b;
  }
  SOFTSCOPE_HD void sumThread(int thread, double (&sums)[kSums]) const {
    for (int s = thread; s < graph.stencils; s += kThreads) {
      const StencilSums& one = graph.stencil_sums[s];
      sums[0] += one.data;
      sums[1] += one.correspondence;
      sums[2] += one.data_abs_mm;
      sums[3] += one.targets;
    }
    for (int e = thread; e < graph.edges; e += kThreads)
      sums[4] += graph.edge_weights[e] * graph.edge_energies[e];
    for (int j = thread; j < graph.nodes; j += kThreads) {
      sums[5] += graph.rest_energies[j];
      if (!with_step) continue;
      const NodeStep& step = graph.steps[j];
      sums[6] += step.predicted_decrease;
      sums[kFurthest] = join(kFurthest, sums[kFurthest], step.furthest_mm);
      sums[11] += step.failures;
    }
    if (with_step) {
      for (int i = thread; i < graph.nodes * kUnknowns; i += kThreads) {
        const double inverse = graph.inverse_pivots[i];
        sums[kLeast] = join(kLeast, sums[kLeast], inverse);
        sums[kLargest] = join(kLargest, sums[kLargest], inverse);
        if (!(inverse > 0)) sums[11] += 1;
      }
      return;
    }
    for (int b = thread; b < graph.blocks; b += kThreads)
      if (graph.diagonal_of[b] >= 0)
        for (int r = 0; r < kUnknowns; ++r)
          sums[kDiagonal] = join(
              kDiagonal, sums[kDiagonal],
              graph.matrix[static_cast<std::ptrdiff_t>(b) * kBlockEntries + r * (kUnknowns + 1)]);
  }
};

}  // namespace softscope::cuda
