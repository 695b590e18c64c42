// cuda/warp/warp_stencils.h: kernel bodies for targets, residuals and the equations of each
// stencil.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/warp/warp_lanes.h"
#include "cuda/warp/warp_layout.h"
#include "deform/energy/robust_loss.h"
#include "deform/kernels/plane_term.h"

namespace softscope::cuda {

/// One thread per node: its displacement for warping, and its constraints.
struct PackNodesKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  WarpStructureLayout graph;
  const NodeTransform* transforms;

  Grid blocks() const { return {blocksFor(graph.nodes, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int j = at.x * kThreads + at.thread;
    if (j >= graph.nodes) return;
    graph.packed[j] = packNode(graph.rest_mm[j], transforms[j]);
    graph.rest_energies[j] = graph.hidden[j] * transforms[j].translation_mm.squaredNorm();
  }
};

/// One thread per point: its warped position, and the target plane there.
struct AssociateKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  WarpStructureLayout graph;
  WarpPointLayout points;
  DepthLookUp surface;
  int count;
  float points_each;
  double data_weight;

  Grid blocks() const { return {blocksFor(count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= count) return;
    const PointBinding& binding = points.bindings[i];
    Eigen::Vector3f warped, normal;
    warpBy(blendOf(graph.packed, graph.stencil_nodes[binding.stencil], binding),
           points.positions_mm[i], points.normals[i], &warped, &normal);
    points.targets[i] = targetOf(warped, normal);
  }

 private:
  SOFTSCOPE_HD PointTarget targetOf(const Eigen::Vector3f& warped,
                                    const Eigen::Vector3f& normal) const {
    PointTarget out = {};
    const Eigen::Vector3f point_left = surface.toLeft(warped);
    const int pixel = surface.pixelOf(point_left);
    if (pixel < 0) return out;
    const PlaneTarget found = surface.targetAt(pixel, point_left, normal);
    if (!(found.reliability > 0)) return out;
    for (int c = 0; c < 3; ++c) {
      out.normal[c] = found.normal[c];
      out.target[c] = found.point_mm[c];
    }
    out.weight = static_cast<float>(data_weight * points_each * found.reliability);
    return out;
  }
};

/// One block per stencil: residuals and robust weights of its rows, their sums and,
/// if it assembles, the ten blocks and four gradients of its normal equations. Four
/// threads per row, 30 rows at a time: the three rows of a match stay together.
template <bool kAssembles>
struct StencilKernel {
  static constexpr int kThreads = 128, kPhases = 6, kRows = 30;
  static constexpr int kRowEntries = kNodesPerPoint * kUnknowns;
  static constexpr int kEntries = kStencilBlocks * kBlockEntries + kRowEntries;
  static constexpr int kEntriesEach = kEntries / kThreads;
  static_assert(kEntries == kThreads * kEntriesEach && kUnknowns % kEntriesEach == 0);
  struct Shared {
    double rows[kRows][kRowEntries];
    double shares[kRows][kNodesPerPoint];
    double residuals[kRows];
    double roots[kRows], pulls[kRows];  // of the weight; times the residual
    StencilSums sums[kRows];
  };
  struct Local {
    double total[kEntriesEach];
    StencilSums sums;
  };
  WarpStructureLayout graph;
  WarpPointLayout points;
  WarpMatchLayout matches;
  const NodeTransform* transforms;
  WarpWeights weights;

  Grid blocks() const { return {graph.stencils, 1, 1}; }
  SOFTSCOPE_HD int repeats(const Place& at) const {
    const int batches = (rowsOf(at.x) + kRows - 1) / kRows;
    return batches > 0 ? batches : 1;
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const int rows = rowsOf(at.x), first = at.repeat * kRows;
    const int batch = rows - first < kRows ? rows - first : kRows;
    const bool is_last = first + kRows >= rows;
    if constexpr (kPhase == 0) {
      if (at.repeat == 0) local = {};
      if (at.thread / kNodesPerPoint < batch) addShare(at, first, shared);
    } else if constexpr (kPhase == 1) {
      if (at.thread < batch) {
        const double* s = shared.shares[at.thread];
        shared.residuals[at.thread] = (s[0] + s[1]) + (s[2] + s[3]);
      }
    } else if constexpr (kPhase == 2) {
      if (at.thread < batch) weigh(at, first, shared, local);
      if (is_last && at.thread < kRows) shared.sums[at.thread] = local.sums;
    } else if constexpr (kPhase == 3) {
      const int slot = at.thread / kNodesPerPoint, k = at.thread % kNodesPerPoint;
      if (kAssembles && slot < batch)
        for (int a = 0; a < kUnknowns; ++a)
          shared.rows[slot][k * kUnknowns + a] *= shared.roots[slot];
    } else if constexpr (kPhase == 4) {
      if constexpr (kAssembles) {
        addRows(at.thread, batch, shared, local.total);
        if (is_last && graph.stencil_nodes[at.x][0] >= 0) store(at, local);
      }
    } else if (is_last && at.thread == 0) {
      StencilSums sums = shared.sums[0];
      for (int r = 1; r < kRows; ++r) {
        sums.data += shared.sums[r].data;
        sums.correspondence += shared.sums[r].correspondence;
        sums.data_abs_mm += shared.sums[r].data_abs_mm;
        sums.targets += shared.sums[r].targets;
      }
      graph.stencil_sums[at.x] = sums;
    }
  }

 private:
  SOFTSCOPE_HD int matchRows(int stencil) const {
    return 3 * (graph.match_start[stencil + 1] - graph.match_start[stencil]);
  }
  SOFTSCOPE_HD int rowsOf(int stencil) const {
    return matchRows(stencil) + graph.point_start[stencil + 1] - graph.point_start[stencil];
  }
  SOFTSCOPE_HD static Vec3<double> vectorOf(const float* p) { return {p[0], p[1], p[2]}; }

  /// Contribution of one node to a residual and to the row of the Jacobian.
  SOFTSCOPE_HD void addShare(const Place& at, int first, Shared& shared) const {
    const int slot = at.thread / kNodesPerPoint, k = at.thread % kNodesPerPoint;
    const int row = first + slot, match_rows = matchRows(at.x);
    Vec3<double> point, normal, target;
    double weight;
    if (row < match_rows) {
      const WarpMatch& match = matches.list[graph.match_start[at.x] + row / 3];
      point = vectorOf(match.source), normal = vectorOf(match.sqrt_information + 3 * (row % 3));
      target = vectorOf(match.target), weight = match.node_weights[k];
    } else {
      const int i = graph.point_start[at.x] + row - match_rows;
      const PointTarget& plane = points.targets[i];
      point = vectorOf(points.positions_mm[i].data()), normal = vectorOf(plane.normal);
      target = vectorOf(plane.target), weight = points.bindings[i].weights[k];
    }
    const int node = graph.stencil_nodes[at.x][static_cast<std::size_t>(k)];
    const NodeTransform& transform = transforms[node];
    const Eigen::Vector3d& g = graph.rest_mm[node];
    double linear[9];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) linear[3 * r + c] = transform.linear(r, c);
    const Vec3<double> rest = {g.x(), g.y(), g.z()};
    const Vec3<double> moved = {g.x() + transform.translation_mm.x(),
                                g.y() + transform.translation_mm.y(),
                                g.z() + transform.translation_mm.z()};
    const Vec3<double> turned = multiply(linear, subtract(point, rest));
    shared.shares[slot][k] = planeShare(turned, moved, target, normal, weight);
    if constexpr (kAssembles)
      rigidPlaneRow(turned, normal, weight, shared.rows[slot] + k * kUnknowns);
  }

  /// docs/energy.md (12) to (14): the three rows of a match share one robust weight.
  SOFTSCOPE_HD void weigh(const Place& at, int first, Shared& shared, Local& local) const {
    const int slot = at.thread, row = first + slot, match_rows = matchRows(at.x);
    const double own = shared.residuals[slot];
    if (row >= match_rows) {
      const double base = points.targets[graph.point_start[at.x] + row - match_rows].weight;
      const RobustValue value = robustValue(weights.data_robust, own * own);
      setWeight(slot, base * value.weight, shared);
      if (!(base > 0)) return;
      local.sums.data += base * value.cost;
      local.sums.data_abs_mm += own < 0 ? -own : own;
      ++local.sums.targets;
      return;
    }
    const double* r = shared.residuals + slot / 3 * 3;
    const double base = weights.correspondence;
    const RobustValue value = robustValue(weights.correspondence_robust, squaredMatch(r));
    setWeight(slot, base * value.weight, shared);
    if (slot % 3 != 0) return;
    local.sums.correspondence += base * value.cost;
  }

  SOFTSCOPE_HD static void setWeight(int slot, double weight, Shared& shared) {
    shared.roots[slot] = std::sqrt(weight);
    shared.pulls[slot] = shared.roots[slot] * shared.residuals[slot];
  }

  /// Three consecutive ones of the 360 entries of the blocks, in
  /// the order of kStencilBlocks, then of the 24 of the gradients.
  SOFTSCOPE_HD static void addRows(int thread, int batch, const Shared& shared,
                                   double (&total)[kEntriesEach]) {
    constexpr int kInBlock = kBlockEntries / kEntriesEach, kMatrix = kStencilBlocks * kInBlock;
    if (thread >= kMatrix) {
      for (int r = 0; r < batch; ++r)
        for (int e = 0; e < kEntriesEach; ++e)
          total[e] = multiplyAdd(shared.pulls[r],
                                 shared.rows[r][(thread - kMatrix) * kEntriesEach + e], total[e]);
      return;
    }
    int i = 0, j = thread / kInBlock;  // the block's column and row
    while (j >= kNodesPerPoint - i) j -= kNodesPerPoint - i++;
    j += i;
    const int inside = thread % kInBlock * kEntriesEach;
    const int column = i * kUnknowns + inside / kUnknowns, row = j * kUnknowns + inside % kUnknowns;
    for (int r = 0; r < batch; ++r)
      for (int e = 0; e < kEntriesEach; ++e)
        total[e] = multiplyAdd(shared.rows[r][column], shared.rows[r][row + e], total[e]);
  }
  SOFTSCOPE_HD void store(const Place& at, const Local& local) const {
    constexpr int kMatrix = kStencilBlocks * kBlockEntries;
    for (int e = 0; e < kEntriesEach; ++e) {
      const int entry = at.thread * kEntriesEach + e;
      if (entry < kMatrix)
        graph.part_blocks[static_cast<std::ptrdiff_t>(at.x) * kMatrix + entry] = local.total[e];
      else
        graph.part_gradients[at.x * kRowEntries + entry - kMatrix] = local.total[e];
    }
  }
};

}  // namespace softscope::cuda
