// cuda/warp/warp_layout.h: arrays of the least-squares problem, planned from its sizes.
#pragma once

#include <cstddef>

#include "cuda/device/arena.h"
#include "deform/solver/warp_device.h"

namespace softscope::cuda {

constexpr int kUnknowns = kRigidUnknowns;
constexpr int kBlockEntries = kUnknowns * kUnknowns;

/// Sums of the rows of one stencil.
struct StencilSums {
  double data, correspondence, data_abs_mm;
  int targets, padding;
};

/// Step at one node.
struct NodeStep {
  double predicted_decrease, furthest_mm, failures;
};

/// Target plane and weight of a point; weight 0: none.
struct PointTarget {
  float normal[3], target[3], weight;
};

/// Depends on the graph's structure.
struct WarpStructureLayout {
  WarpStructureLayout() = default;
  WarpStructureLayout(Arena& arena, const WarpStructure& of)
      : nodes(of.nodes),
        stencils(static_cast<int>(of.stencils.size())),
        edges(static_cast<int>(of.edges.size() / 2)),
        blocks(static_cast<int>(of.diagonal_of.size())) {
    stencil_nodes = arena.array<NodeStencil>(of.stencils.size());
    edge_nodes = arena.array<std::int32_t>(of.edges.size());
    diagonal_of = arena.array<std::int32_t>(of.diagonal_of.size());
    block_start = arena.array<int>(of.parts.blocks.start.size());
    block_list = arena.array<int>(of.parts.blocks.parts.size());
    gradient_start = arena.array<int>(of.parts.gradients.start.size());
    gradient_list = arena.array<int>(of.parts.gradients.parts.size());
    fronts = arena.array<FrontShape>(of.fronts.fronts.size());
    front_nodes = arena.array<int>(of.fronts.nodes.size());
    look_up = arena.array<int>(of.fronts.look_up.size());
    children = arena.array<FrontChild>(of.fronts.children.size());
    maps = arena.array<int>(of.fronts.maps.size());
    const auto unknowns = static_cast<std::size_t>(nodes * kUnknowns);
    part_blocks = arena.array<double>(static_cast<std::size_t>(of.parts.block_parts) *
                                      static_cast<std::size_t>(kBlockEntries));
    part_gradients = arena.array<double>(static_cast<std::size_t>(of.parts.gradient_parts) *
                                         static_cast<std::size_t>(kUnknowns));
    matrix = arena.array<double>(of.diagonal_of.size() * static_cast<std::size_t>(kBlockEntries));
    gradient = arena.array<double>(unknowns);
    factor = arena.array<double>(of.fronts.factor_doubles);
    inverses = arena.array<double>(unknowns * static_cast<std::size_t>(kMostPivots * kUnknowns));
    updates = arena.array<double>(of.fronts.update_doubles);
    inverse_pivots = arena.array<double>(unknowns);
    solution = arena.array<double>(unknowns);
    stencil_sums = arena.array<StencilSums>(of.stencils.size());
    edge_energies = arena.array<double>(static_cast<std::size_t>(edges));
    const auto count = static_cast<std::size_t>(nodes);
    rest_energies = arena.array<double>(count);
    steps = arena.array<NodeStep>(count);
    rest_mm = arena.array<Eigen::Vector3d>(count);
    for (NodeTransform*& each : transforms) each = arena.array<NodeTransform>(count);
    packed = arena.array<PackedNode>(count);
    hidden = arena.array<double>(count);
    edge_weights = arena.array<double>(static_cast<std::size_t>(edges));
    expected = arena.array<ExpectedOffsets>(static_cast<std::size_t>(edges));
    point_start = arena.array<int>(of.stencils.size() + 1);
    match_start = arena.array<int>(of.stencils.size() + 1);
    sums = arena.array<WarpSums>(1);
  }

  int nodes = 0, stencils = 0, edges = 0, blocks = 0;
  NodeStencil* stencil_nodes;
  std::int32_t *edge_nodes, *diagonal_of;
  int *block_start, *block_list, *gradient_start, *gradient_list;
  FrontShape* fronts;
  int *front_nodes, *look_up;
  FrontChild* children;
  int* maps;
  double *part_blocks, *part_gradients;
  double *matrix, *gradient;  // blocks of the pattern, column-major; per node
  double *factor, *updates, *inverse_pivots;
  double* inverses;  // of L^T in the pivots of each front, by columns
  double* solution;
  StencilSums* stencil_sums;
  double *edge_energies, *rest_energies;
  NodeStep* steps;
  Eigen::Vector3d* rest_mm;
  NodeTransform* transforms[2];
  PackedNode* packed;
  double *hidden, *edge_weights;
  ExpectedOffsets* expected;
  int *point_start, *match_start;
  WarpSums* sums;
};

/// The points of a frame, and their targets.
struct WarpPointLayout {
  WarpPointLayout() = default;
  WarpPointLayout(Arena& arena, std::size_t count) {
    positions_mm = arena.array<Eigen::Vector3f>(count);
    normals = arena.array<Eigen::Vector3f>(count);
    bindings = arena.array<PointBinding>(count);
    targets = arena.array<PointTarget>(count);
  }

  Eigen::Vector3f *positions_mm = nullptr, *normals = nullptr;
  PointBinding* bindings = nullptr;
  PointTarget* targets = nullptr;
};

/// The matches of a frame, three rows each.
struct WarpMatchLayout {
  WarpMatchLayout() = default;
  WarpMatchLayout(Arena& arena, std::size_t matches) : count(matches) {
    list = arena.array<WarpMatch>(matches);
  }

  WarpMatch* list = nullptr;
  std::size_t count = 0;
};

/// The depth map of a frame.
struct WarpSurfaceLayout {
  WarpSurfaceLayout(Arena& arena, std::size_t pixels) {
    depth_mm = arena.array<float>(pixels);
    sigma_mm = arena.array<float>(pixels);
    normals = arena.array<Eigen::Vector3f>(pixels);
  }

  float *depth_mm, *sigma_mm;
  Eigen::Vector3f* normals;
};

}  // namespace softscope::cuda
