// cuda/warp/model_warp_run.h: the warp of the model on the device, on any machine.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cuda/device/kernel.h"
#include "cuda/model/model_home.h"
#include "cuda/warp/warp_lanes.h"
#include "deform/graph/model_warp.h"
#include "deform/graph/warp.h"

namespace softscope::cuda {

/// Nodes and stencils of the graph, of which a warp needs no more.
struct ModelWarpLayout {
  ModelWarpLayout() = default;
  ModelWarpLayout(Arena& arena, std::size_t nodes, std::size_t stencils)
      : packed(arena.array<PackedNode>(nodes)), stencil_nodes(arena.array<NodeStencil>(stencils)) {}

  PackedNode* packed = nullptr;
  NodeStencil* stencil_nodes = nullptr;
};

/// One thread per point: the point and its normal, in place. Unbound points stay.
struct WarpModelKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ModelWarpLayout graph;
  ModelArrays model;
  int count;

  Grid blocks() const { return {blocksFor(count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= count) return;
    const PointBinding& binding = model.bindings[i];
    if (!binding.bound()) return;
    Eigen::Vector3f warped, normal;
    warpBy(blendOf(graph.packed, graph.stencil_nodes[binding.stencil], binding),
           model.positions_mm[i], model.normals[i], &warped, &normal);
    model.positions_mm[i] = warped;
    model.normals[i] = normal;
  }
};

/// Machine: as WarpRun has it. The host's points stay as they were.
template <class Machine>
class ModelWarpRun final : public ModelWarp {
 public:
  template <class... Arguments>
  explicit ModelWarpRun(std::shared_ptr<ModelHome<Machine>> home, Arguments&&... arguments)
      : home_(std::move(home)), machine_(std::forward<Arguments>(arguments)...) {}

  bool apply(const WarpGraph& graph, PointModel* model) override {
    const ModelArrays& to = home_->bring(*model, kModelShape | kModelBindings, 0, machine_);
    reserve(graph);
    const std::vector<PackedNode> packed = packNodes(graph);
    send(graph_.packed, packed);
    send(graph_.stencil_nodes, graph.stencils);
    const WarpModelKernel kernel{graph_, to, static_cast<int>(model->size())};
    home_->changed(kModelShape);  // unless this succeeds
    machine_.executor().launch("warp model", kernel, kernel.blocks());
    machine_.wait();
    home_->isAhead(kModelShape);
    return false;
  }
  void undo(PointModel* /*model*/) override { home_->changed(kModelShape); }

 private:
  using Memory = typename Machine::Memory;

  /// For twice as large a graph, so that a growing one rarely reallocates.
  void reserve(const WarpGraph& graph) {
    Arena counting;
    const ModelWarpLayout planned(counting, graph.size(), graph.stencils.size());
    if (memory_.bytes() < counting.bytes()) {
      memory_ = Memory();
      memory_ = Memory(2 * counting.bytes(), "memory for the warp of the model");
    }
    Arena arena(memory_.data());
    graph_ = ModelWarpLayout(arena, graph.size(), graph.stencils.size());
  }
  template <class T>
  void send(T* to, const std::vector<T>& from) {
    if (!from.empty()) machine_.toDevice(to, from.data(), from.size() * sizeof(T));
  }

  std::shared_ptr<ModelHome<Machine>> home_;
  Memory memory_;
  Machine machine_;
  ModelWarpLayout graph_;
};

}  // namespace softscope::cuda
