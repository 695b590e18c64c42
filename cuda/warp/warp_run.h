// cuda/warp/warp_run.h: memory, copies and launches of the warp's least-squares problem, on any
// machine.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cuda/device/grown_memory.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/model/model_home.h"
#include "cuda/warp/warp_passes.h"
#include "deform/solver/warp_device.h"

namespace softscope::cuda {

/// A Machine has an executor(), a Memory(bytes, what) with data() and bytes(), the
/// same as Pinned memory of the host, and toDevice(), fromDevice(), wait() as in Stream.
template <class Machine>
class WarpRun final : public WarpDevice {
 public:
  template <class... Arguments>
  explicit WarpRun(const WarpWeights& weights, Arguments&&... arguments)
      : machine_(std::forward<Arguments>(arguments)...), passes_(machine_.executor()) {
    inputs_.weights = weights;
  }
  /// Rasters already on the device are not copied again.
  void share(std::shared_ptr<const SharedRasters> shared) { shared_ = std::move(shared); }
  /// The model on the device, of which the points in sight are taken.
  void share(std::shared_ptr<ModelHome<Machine>> home) { home_ = std::move(home); }
  ~WarpRun() override = default;

  void setStructure(const WarpStructure& structure) override {
    fronts_ = structure.fronts;
    Arena counting;
    WarpStructureLayout planned(counting, structure);
    reserve(counting.bytes(), &structure_memory_);
    Arena arena(structure_memory_.data());
    graph_ = WarpStructureLayout(arena, structure);
    const FrontTables& fronts = structure.fronts;
    send(graph_.stencil_nodes, structure.stencils);
    send(graph_.edge_nodes, structure.edges);
    send(graph_.diagonal_of, structure.diagonal_of);
    send(graph_.block_start, structure.parts.blocks.start);
    send(graph_.block_list, structure.parts.blocks.parts);
    send(graph_.gradient_start, structure.parts.gradients.start);
    send(graph_.gradient_list, structure.parts.gradients.parts);
    send(graph_.fronts, fronts.fronts);
    send(graph_.front_nodes, fronts.nodes);
    send(graph_.look_up, fronts.look_up);
    send(graph_.children, fronts.children);
    send(graph_.maps, fronts.maps);
    machine_.wait();
  }

  void setSurface(const DepthLookUp& surface) override {
    inputs_.surface = surface;
    if (shared_ && shared_->holds(surface.depth_mm)) {
      inputs_.surface.depth_mm = shared_->depth_mm;
      inputs_.surface.normals = shared_->normals;
      inputs_.surface.sigma_mm = shared_->sigma_mm;
      return;
    }
    const bool has_depth = surface.depth_mm != nullptr;
    const auto pixels = has_depth ? static_cast<std::size_t>(surface.width_px) *
                                        static_cast<std::size_t>(surface.height_px)
                                  : 0;
    Arena counting;
    WarpSurfaceLayout planned(counting, pixels);
    reserve(counting.bytes(), &surface_memory_);
    Arena arena(surface_memory_.data());
    const WarpSurfaceLayout to(arena, pixels);
    if (!has_depth) inputs_.surface.width_px = inputs_.surface.height_px = 0;  // no targets
    send(to.depth_mm, surface.depth_mm, pixels);
    send(to.normals, surface.normals, pixels);
    if (surface.use_sigma) send(to.sigma_mm, surface.sigma_mm, pixels);
    inputs_.surface.depth_mm = to.depth_mm;
    inputs_.surface.normals = to.normals;
    inputs_.surface.sigma_mm = to.sigma_mm;
    machine_.wait();
  }

  void setPoints(const WarpPoints& points) override {
    const auto count = static_cast<std::size_t>(points.count);
    planPoints(count);
    send(points_.positions_mm, points.positions_mm, count);
    send(points_.normals, points.normals, count);
    send(points_.bindings, points.bindings, count);
    send(graph_.point_start, points.start, static_cast<std::size_t>(graph_.stencils) + 1);
    inputs_.points = points.count;
    inputs_.points_each = points.points_each;
    machine_.wait();
  }

  std::optional<NodeLoads> setSeenPoints(const PointModel& model) override {
    if (!home_ || home_->seen() == nullptr) return std::nullopt;
    const SeenModel of{home_->bring(model, kModelShape | kModelBindings, 0, machine_),
                       home_->seen(), static_cast<int>(model.size())};
    planPoints(model.size());
    const PointListLayout list = planList(model.size());
    passes_.listPoints(graph_, of, list, points_);
    PointListCounts counts;
    std::vector<FixedSum> sums(2 * static_cast<std::size_t>(graph_.nodes));
    machine_.fromDevice(&counts, list.counts, sizeof counts);
    machine_.fromDevice(sums.data(), list.loads, sums.size() * sizeof(FixedSum));
    machine_.wait();
    if (counts.longest > SortPointsKernel::kMost) return std::nullopt;
    inputs_.points = counts.listed;
    inputs_.points_each = 1;
    NodeLoads loads;
    for (std::size_t j = 0; j < sums.size(); ++j)
      (j < sums.size() / 2 ? loads.all : loads.seen).push_back(fromFixed(sums[j]));
    return loads;
  }

  void setMatches(int matches, const std::function<void(const WarpMatches&)>& fill) override {
    const auto count = static_cast<std::size_t>(matches);
    const auto starts = static_cast<std::size_t>(graph_.stencils) + 1;
    Arena counting;
    WarpMatchLayout planned(counting, count);
    reserve(counting.bytes(), &match_memory_);
    Arena arena(match_memory_.data());
    matches_ = WarpMatchLayout(arena, count);
    Arena room;
    room.array<WarpMatch>(count);
    room.array<int>(starts);
    growTo(room.bytes(), "pinned memory for matches", &given_matches_);
    room = Arena(given_matches_.data());
    const WarpMatches given{room.array<WarpMatch>(count), room.array<int>(starts)};
    fill(given);
    send(matches_.list, given.matches, count);
    send(graph_.match_start, given.start, starts);  // both arrive before linearise() runs
  }

  void setNodes(const WarpNodes& from) override {
    const auto nodes = static_cast<std::size_t>(graph_.nodes);
    const auto edges = static_cast<std::size_t>(graph_.edges);
    accepted_ = 0;
    send(graph_.rest_mm, from.rest_mm, nodes);
    send(graph_.transforms[accepted_], from.transforms, nodes);
    send(graph_.hidden, from.hidden, nodes);
    send(graph_.edge_weights, from.edge_weights, edges);
    send(graph_.expected, from.expected, edges);
    inputs_.lever_mm = from.lever_mm;
    machine_.wait();
  }

  WarpSums linearise() override {
    passes_.linearise(graph_, points_, matches_, inputs_, accepted());
    const WarpSums sums = fetchSums();
    floor_ = SolverOptions::kDiagonalFloor * sums.largest_diagonal;
    return sums;
  }
  std::vector<int> targetCounts() override {
    const auto stencils = static_cast<std::size_t>(graph_.stencils);
    const StencilSums* sums = fetch(graph_.stencil_sums, stencils);
    std::vector<int> counts(stencils);
    for (std::size_t s = 0; s < stencils; ++s) counts[s] = sums[s].targets;
    return counts;
  }
  WarpSums tryStep(double damping) override {
    passes_.factor(graph_, fronts_, {damping, floor_});
    passes_.step(graph_, fronts_, points_, matches_, inputs_, damping, accepted(), trial());
    return fetchSums();
  }
  void acceptStep() override { accepted_ = 1 - accepted_; }
  std::vector<NodeTransform> transforms() override {
    const NodeTransform* found = fetch(accepted(), static_cast<std::size_t>(graph_.nodes));
    return {found, found + graph_.nodes};
  }

 private:
  using Memory = typename Machine::Memory;

  NodeTransform* accepted() const { return graph_.transforms[accepted_]; }
  NodeTransform* trial() const { return graph_.transforms[1 - accepted_]; }
  void planPoints(std::size_t count) {
    Arena counting;
    WarpPointLayout planned(counting, count);
    reserve(counting.bytes(), &point_memory_);
    Arena arena(point_memory_.data());
    points_ = WarpPointLayout(arena, count);
  }
  PointListLayout planList(std::size_t points) {
    const auto stencils = static_cast<std::size_t>(graph_.stencils);
    const auto nodes = static_cast<std::size_t>(graph_.nodes);
    Arena counting;
    PointListLayout planned(counting, stencils, nodes, points);
    reserve(counting.bytes(), &list_memory_);
    Arena arena(list_memory_.data());
    return {arena, stencils, nodes, points};
  }
  void reserve(std::size_t bytes, Memory* memory) { growTo(bytes, "memory for the warp", memory); }
  template <class T>
  void send(T* to, const T* from, std::size_t count) {
    if (count > 0) machine_.toDevice(to, from, count * sizeof(T));
  }
  template <class T>
  void send(T* to, const std::vector<T>& from) {
    send(to, from.data(), from.size());
  }
  WarpSums fetchSums() { return *fetch(graph_.sums, 1); }
  /// Valid until the next call. Pinned memory is copied to without a detour.
  template <class T>
  const T* fetch(const T* from, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    growTo(bytes, "pinned memory for the warp", &arrived_);
    if (bytes > 0) machine_.fromDevice(arrived_.data(), from, bytes);
    machine_.wait();
    return static_cast<const T*>(arrived_.data());
  }

  Memory structure_memory_, surface_memory_, point_memory_, list_memory_, match_memory_;
  typename Machine::Pinned arrived_, given_matches_;
  Machine machine_;
  WarpPasses<typename Machine::Executor> passes_;
  FrontTables fronts_;
  WarpStructureLayout graph_;
  WarpPointLayout points_;
  WarpMatchLayout matches_;
  std::shared_ptr<const SharedRasters> shared_;
  std::shared_ptr<ModelHome<Machine>> home_;
  WarpInputs inputs_;
  int accepted_ = 0;
  double floor_ = 0;
};

}  // namespace softscope::cuda
