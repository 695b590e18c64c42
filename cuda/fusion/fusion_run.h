// cuda/fusion/fusion_run.h: memory, copies and launches of stage 7, on any machine.
#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/error.h"
#include "cuda/device/downlink.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/frame/raster_layout.h"
#include "cuda/fusion/fusion_passes.h"
#include "cuda/model/model_home.h"
#include "fusion/model_updater.h"

namespace softscope::cuda {

/// Machine: as WarpRun has it, with Pinned memory of the host.
template <class Machine>
class FusionRun final : public ModelUpdater {
 public:
  template <class... Arguments>
  explicit FusionRun(const PinholeCamera& left, Arguments&&... arguments)
      : pixels_(static_cast<std::size_t>(left.width_px) * static_cast<std::size_t>(left.height_px)),
        home_(std::make_shared<ModelHome<Machine>>()),
        machine_(std::forward<Arguments>(arguments)...),
        passes_(machine_.executor()) {
    Arena counting;
    FusionFrameLayout(counting, pixels_);
    frame_memory_ = Memory(counting.bytes(), kWhat);
    memory_arrived_ = typename Machine::Pinned(pixels_ * sizeof(float), kWhat);
    Arena arena(frame_memory_.data());
    image_ = FusionFrameLayout(arena, pixels_);
    reservePoints(pixels_ + pixels_ / 4);
  }
  /// Rasters that lie on the device already are not copied again.
  void share(std::shared_ptr<const SharedRasters> shared) { shared_ = std::move(shared); }
  /// The model on the device, which other stages use as well.
  void share(std::shared_ptr<ModelHome<Machine>> home) { home_ = std::move(home); }

  void changed(ModelParts parts) override {
    if ((parts & kModelMemory) != 0) {
      is_memory_due_ = false;
      is_memory_current_ = false;
    }
    home_->changed(parts);
  }
  /// Asks nothing of the device, which may have failed since.
  void fetch(InsertionMemory* memory) override {
    if (!is_memory_due_) return;
    is_memory_due_ = false;
    const auto* arrived = static_cast<const float*>(memory_arrived_.data());
    memory->unexplained_mm.values.assign(arrived, arrived + pixels_);
  }

  ModelUpdateSummary update(const Observation& observation, const Raster<PixelState>& states,
                            const WarpGraph& graph, const FusionOptions& options,
                            const ModelComparison& comparison, InsertionMemory* memory,
                            PointModel* model) override {
    options.validate();
    observation.validate();
    requireStates(states, observation);
    if (home_->sights() == nullptr) requireVisibility(comparison.visibility, *model);
    require(options.density.cell_mm >= 0.01, "fusion.point_spacing_mm", options.density.cell_mm,
            "must be 0.01 or more");
    FusionWork work;
    work.frame = fusingFrame(observation, comparison.gain, options.points, options.colour);
    takeFrame(observation, states, &work);
    takeModel(*model, comparison, &work);
    takeGraph(graph, comparison.innovation, &work);
    work.anchored = sendAnchored(comparison.anchored);
    work.insertion = insertionLimits(options.insertion);
    work.last = sendLast(*memory);
    work.at_once = !options.insertion.confirm || model->empty();
    work.cell_mm = static_cast<float>(options.density.cell_mm);
    work.least_cosine = static_cast<float>(std::cos(DensityOptions::kMaxAngleDeg * M_PI / 180));
    passes_.update(work);
    return takeResult(observation, comparison, work, memory, model);
  }

 private:
  using Memory = typename Machine::Memory;
  static constexpr const char* kWhat = "memory for fusion";

  void takeFrame(const Observation& observation, const Raster<PixelState>& states,
                 FusionWork* work) {
    const DepthMap& depth = observation.depth;
    const bool has_sigma = !depth.sigma_mm.empty(), has_colour = !observation.colour.empty();
    if (shared_ && shared_->holds(depth.depth_mm.values.data())) {
      work->frame.rasters = {shared_->depth_mm, has_sigma ? shared_->sigma_mm : nullptr,
                             shared_->normals, has_colour ? shared_->colour : nullptr};
      work->states = shared_->states;
    } else {
      const RasterLayout& own = own_rasters_.send(observation, states, machine_);
      work->frame.rasters = {own.depth_mm, has_sigma ? own.sigma_mm : nullptr, own.normals,
                             has_colour ? own.colour : nullptr};
      work->states = own.states;
    }
    work->image = image_;
    work->unexplained_mm = image_.unexplained_mm[current_];
  }
  void takeModel(const PointModel& model, const ModelComparison& comparison, FusionWork* work) {
    work->model = home_->bring(model, kWholeModel & ~kModelMemory, pixels_, machine_);
    work->updated = home_->other();
    work->count = static_cast<int>(model.size());
    reservePoints(home_->capacity());
    work->sights = home_->sights();
    if (work->sights == nullptr) {
      send(points_.sights, comparison.visibility.points);
      work->sights = points_.sights;
    }
    work->points = points_;
  }
  FusionGraphLayout reserveGraph(const WarpGraph& graph) {
    Arena counting;
    FusionGraphLayout(counting, graph.size(), graph.stencils.size());
    if (graph_memory_.bytes() < counting.bytes()) {
      graph_memory_ = Memory();
      graph_memory_ = Memory(2 * counting.bytes(), kWhat);
    }
    Arena arena(graph_memory_.data());
    return FusionGraphLayout(arena, graph.size(), graph.stencils.size());
  }
  void takeGraph(const WarpGraph& graph, const InnovationField& innovation, FusionWork* work) {
    FusionGraphLayout& to = work->graph;
    to = reserveGraph(graph);
    to.has_innovation = !innovation.nodes().empty();
    send(to.stencils, graph.stencils);
    send(to.nodes_mm, graph.positions_mm);
    send(to.innovation, innovation.nodes());
  }
  AnchoredBlocks sendAnchored(const AnchorAgreement& anchored) {
    const Mask& blocks = anchored.blocks();
    if (blocks.empty()) return {};
    send(image_.anchored, blocks.values);
    return {image_.anchored, anchored.imageWidthPx(), anchored.blockPx(), blocks.width_px};
  }
  /// The last frame's unexplained depths lie on the device, unless the host's are others.
  LastUnexplained sendLast(const InsertionMemory& memory) {
    const Raster<float>& depth_mm = memory.unexplained_mm;
    float* last_mm = image_.unexplained_mm[1 - current_];
    if (!is_memory_current_) {
      if (depth_mm.size() > pixels_) {  // of another camera
        last_memory_ = Memory(depth_mm.size() * sizeof(float), kWhat);
        last_mm = static_cast<float*>(last_memory_.data());
      }
      send(last_mm, depth_mm.values);
    }
    return {last_mm, depth_mm.width_px, depth_mm.height_px,
            posedCamera(memory.left, memory.world_from_left)};
  }

  ModelUpdateSummary takeResult(const Observation& observation, const ModelComparison& comparison,
                                const FusionWork& work, InsertionMemory* memory,
                                PointModel* model) {
    FusionCounts counts;
    machine_.fromDevice(&counts, image_.counts, sizeof counts);
    machine_.wait();
    const auto before = static_cast<std::size_t>(work.count + counts.inserted);
    const auto kept = static_cast<std::size_t>(counts.kept);
    home_->swap(kept);
    current_ = 1 - current_;
    ModelUpdateSummary summary;
    summary.seen = counts.seen;
    summary.points = {counts.fused, counts.contradicted, comparison.gain};
    summary.insertion = {counts.unexplained_px, counts.inserted};
    summary.index_map.new_count = counts.kept;
    machine_.fromDevice(memory_arrived_.data(), work.unexplained_mm, pixels_ * sizeof(float));
    downlink_.add(points_.new_of_old, before, &summary.index_map.new_of_old);
    const ModelArrays& from = home_->arrays();
    downlink_.add(from.positions_mm, kept, &model->positions_mm);
    downlink_.add(from.normals, kept, &model->normals);
    downlink_.add(from.colours, kept, &model->colours);
    downlink_.add(from.anchors, kept, &model->anchors);
    downlink_.add(from.weights, kept, &model->weights);
    downlink_.add(from.bindings, kept, &model->bindings);
    downlink_.fetch(machine_);  // here the host's model changes
    memory->left = observation.left;
    memory->world_from_left = observation.world_from_left;
    memory->unexplained_mm.width_px = observation.left.width_px;
    memory->unexplained_mm.height_px = observation.left.height_px;
    memory->unexplained_mm.values.resize(pixels_);  // their values come with fetch()
    is_memory_due_ = is_memory_current_ = true;
    return summary;
  }

  void reservePoints(std::size_t capacity) {
    if (capacity <= points_.capacity) return;
    Arena counting;
    FusionPointLayout(counting, capacity);
    point_memory_ = Memory();
    point_memory_ = Memory(counting.bytes(), kWhat);
    Arena arena(point_memory_.data());
    points_ = FusionPointLayout(arena, capacity);
  }
  template <class T>
  void send(T* to, const std::vector<T>& from) {
    if (!from.empty()) machine_.toDevice(to, from.data(), from.size() * sizeof(T));
  }

  std::size_t pixels_;
  std::shared_ptr<ModelHome<Machine>> home_;
  Memory frame_memory_, point_memory_, graph_memory_, last_memory_;
  OwnRasters<Machine> own_rasters_;
  typename Machine::Pinned memory_arrived_;
  Machine machine_;
  FusionPasses<typename Machine::Executor> passes_;
  Downlink<Machine> downlink_;
  FusionFrameLayout image_;
  FusionPointLayout points_;
  std::shared_ptr<const SharedRasters> shared_;
  bool is_memory_due_ = false;      // to the host, where it has arrived in pinned memory
  bool is_memory_current_ = false;  // on the device
  int current_ = 0;                 // of the two rasters of unexplained depths
};

}  // namespace softscope::cuda
