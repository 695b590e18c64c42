// cuda/comparison/comparison_run.h: memory, copies and launches of the comparison of model and
// frame, on any machine.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "cuda/comparison/comparison_passes.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/frame/raster_layout.h"
#include "cuda/model/model_home.h"
#include "fusion/frame_comparer.h"

namespace softscope::cuda {

/// Machine: as WarpRun has it.
template <class Machine>
class ComparisonRun final : public FrameComparer {
 public:
  template <class... Arguments>
  explicit ComparisonRun(const PinholeCamera& left, Arguments&&... arguments)
      : machine_(std::forward<Arguments>(arguments)...), passes_(machine_.executor()) {
    Arena counting;
    const ComparisonFrameLayout planned(counting, left.width_px, left.height_px);
    frame_memory_ = Memory(counting.bytes(), kWhat);
    Arena arena(frame_memory_.data());
    frame_ = ComparisonFrameLayout(arena, left.width_px, left.height_px);
    totals_.resize(frame_.totals_bytes);
    reserveModel(static_cast<std::size_t>(left.width_px) *
                 static_cast<std::size_t>(left.height_px) / 4);
    std::vector<std::int16_t> bins(256 * 256, -1);
    for (int seen = 0; seen < 256; ++seen)
      for (int known = 1; known < 256; ++known)
        bins[static_cast<std::size_t>(seen * 256 + known)] = static_cast<std::int16_t>(
            gainBin(static_cast<std::uint8_t>(seen), static_cast<std::uint8_t>(known)));
    send(frame_.gain_bins, bins);
    machine_.wait();
  }
  /// Rasters already on the device are not copied again.
  void share(std::shared_ptr<const SharedRasters> shared) { shared_ = std::move(shared); }
  /// A model that knows what has changed; what compare() says of its points stays there, and the
  /// visibility that it returns is empty.
  void share(std::shared_ptr<ModelHome<Machine>> home) { shared_home_ = std::move(home); }

  std::vector<std::int32_t> visiblePoints(const PointModel& model, const Observation& observation,
                                          const Raster<PixelState>& states,
                                          const VisibilityOptions& options) override {
    needFrame(observation, states);
    takeModel(model, kModelShape);
    const bool draws = false;
    passes_.findSight(frame_, model_, cameraOf(observation), sightLimits(options), draws);
    seen_.resize(model.size());
    machine_.fromDevice(seen_.data(), model_.seen, seen_.size());
    machine_.wait();
    if (shared_home_) shared_home_->setSeen(model_.seen);
    std::vector<std::int32_t> indices;
    indices.reserve(model.size());
    for (std::size_t i = 0; i < seen_.size(); ++i)
      if (seen_[i] != 0) indices.push_back(static_cast<std::int32_t>(i));
    return indices;
  }

  FrameComparison compare(const PointModel& model, const WarpGraph& graph,
                          const Observation& observation, const Raster<PixelState>& states,
                          const FusionOptions& options) override {
    options.validate();
    needFrame(observation, states);
    const SeenQuestions asked = questionsOf(options, model.size());
    takeModel(model, kModelShape | kModelLooks | (asked.innovation ? kModelBindings : 0));
    const PosedCamera camera = cameraOf(observation);
    const bool draws = true, compares_images = true;
    passes_.findSight(frame_, model_, camera, sightLimits(options.visibility), draws);
    passes_.comparePixels(frame_, model_, camera, compares_images);
    if (asked.innovation) sendGraph(graph);  // beside the kernels
    passes_.findVisiblePoints(frame_, model_, graph_, asked);
    FrameComparison found;
    if (shared_home_) {
      shared_home_->setSights(model_.sights);
    } else {
      std::vector<PointSight>& sights = found.model.visibility.points;
      sights.resize(model.size());
      machine_.fromDevice(sights.data(), model_.sights, sights.size() * sizeof(PointSight));
    }
    std::vector<InnovationSums> nodes(asked.innovation ? graph.size() : 0);
    if (!nodes.empty())
      machine_.fromDevice(nodes.data(), graph_.sums, nodes.size() * sizeof(InnovationSums));
    fetchTotals();
    found.predicted = errorOf(totals());
    found.view = viewOf();
    if (asked.gain)
      found.model.gain = {gainOf(totals().gain[0]), gainOf(totals().gain[1]),
                          gainOf(totals().gain[2])};
    if (asked.anchors)
      found.model.anchored = AnchorAgreement(frame_.width, fetched(frame_.anchors));
    if (totals().frame.weight != 0) found.model.innovation = innovationOf(nodes, totals().frame);
    return found;
  }

  BackProjectionError error(const PointModel& model, const Observation& observation,
                            const Raster<PixelState>& states) override {
    needFrame(observation, states);
    takeModel(model, kModelShape);
    const PosedCamera camera = cameraOf(observation);
    const bool draws = true, compares_images = false;
    passes_.findSight(frame_, model_, camera, sightLimits({}), draws);
    passes_.comparePixels(frame_, model_, camera, compares_images);
    fetchTotals();
    return errorOf(totals());
  }

 private:
  using Memory = typename Machine::Memory;
  static constexpr const char* kWhat = "memory for comparing model and frame";

  void needFrame(const Observation& observation, const Raster<PixelState>& states) {
    observation.validate();
    const DepthMap& depth = observation.depth;
    frame_.has_sigma = !depth.sigma_mm.empty();
    frame_.has_colour = !observation.colour.empty();
    if (shared_ && shared_->holds(depth.depth_mm.values.data())) return takeRasters(*shared_);
    takeRasters(own_rasters_.send(observation, states, machine_));
    machine_.wait();
  }
  template <class Rasters>
  void takeRasters(const Rasters& from) {
    frame_.depth_mm = from.depth_mm;
    frame_.sigma_mm = from.sigma_mm;
    frame_.normals = from.normals;
    frame_.states = from.states;
    frame_.colour = from.colour;
  }
  void takeModel(const PointModel& model, ModelParts parts) {
    ModelHome<Machine>& home = shared_home_ ? *shared_home_ : own_home_;
    if (!shared_home_) home.changed(kWholeModel);
    home.forgetFrame();  // the one before
    reserveModel(model.size());
    static_cast<ModelArrays&>(model_) = home.bring(model, parts, 0, machine_);
    model_.count = static_cast<int>(model.size());
  }
  void sendGraph(const WarpGraph& graph) {
    Arena counting;
    const ComparisonGraphLayout planned(counting, graph.size(), graph.stencils.size());
    if (graph_memory_.bytes() < counting.bytes()) {
      graph_memory_ = Memory();
      graph_memory_ = Memory(2 * counting.bytes(), kWhat);
    }
    Arena arena(graph_memory_.data());
    graph_ = ComparisonGraphLayout(arena, graph.size(), graph.stencils.size());
    send(graph_.stencils, graph.stencils);
  }
  /// Twice the points at a time, so that a growing model rarely reallocates.
  void reserveModel(std::size_t points) {
    if (points <= capacity_) return;
    capacity_ = capacity_ == 0 ? points : 2 * points;
    Arena counting;
    const ComparisonModelLayout planned(counting, capacity_);
    model_memory_ = Memory();
    model_memory_ = Memory(counting.bytes(), kWhat);
    Arena arena(model_memory_.data());
    model_ = ComparisonModelLayout(arena, capacity_);
    ResetKernel reset;  // sights have padding, which is copied with them
    reset.add(model_.sights, capacity_ * sizeof(PointSight) / sizeof(std::uint32_t), 0);
    machine_.executor().launch("reset", reset, reset.blocks());
  }

  SeenQuestions questionsOf(const FusionOptions& options, std::size_t points) const {
    SeenQuestions asked;
    asked.colour = options.colour;
    asked.gain = options.colour.compensate_gain && frame_.has_colour;
    asked.gain_stride = static_cast<int>(gainStride(points));
    asked.anchors = options.colour.hold_anchors && frame_.has_colour;
    asked.innovation = options.points.follow_innovation && frame_.has_sigma &&
                       options.points.reference_sigma_mm > 0;
    asked.reference_mm = static_cast<float>(options.points.reference_sigma_mm);
    asked.largest_weight = static_cast<float>(options.points.max_measurement_weight);
    return asked;
  }

  void fetchTotals() {
    machine_.fromDevice(totals_.data(), frame_.totals, totals_.size());
    machine_.wait();
  }
  const ComparisonTotals& totals() const {
    return *reinterpret_cast<const ComparisonTotals*>(totals_.data());
  }
  /// `sums` are those on the device.
  CorrelationBlocks fetched(const BlockSums* sums) const {
    const auto offset =
        reinterpret_cast<const char*>(sums) - reinterpret_cast<const char*>(frame_.totals);
    const auto* here = reinterpret_cast<const BlockSums*>(totals_.data() + offset);
    return CorrelationBlocks::from(here, frame_.width, frame_.height);
  }

  static BackProjectionError errorOf(const ComparisonTotals& totals) {
    BackProjectionError error;
    error.compared_px = static_cast<int>(totals.differences);
    if (error.compared_px == 0) return error;
    error.mean_mm = fromFixed(totals.absolute_mm) / error.compared_px;
    error.bias_mm = fromFixed(totals.difference_mm) / error.compared_px;
    error.p95_mm = bitsAsFloat(totals.rank.bits);
    return error;
  }
  ViewEvidence viewOf() const {
    return evidenceOf(totals().compared_px, totals().agreeing_px, fetched(frame_.evidence));
  }
  static InnovationField innovationOf(const std::vector<InnovationSums>& nodes,
                                      const InnovationSums& frame) {
    const double weight = fromFixed(frame.weight);
    std::vector<Innovation> field;
    field.reserve(nodes.size());
    for (const InnovationSums& node : nodes) {
      const auto mean = [&](FixedSum InnovationSums::*sum) {
        return innovationMean(fromFixed(node.*sum), fromFixed(node.weight), fromFixed(frame.*sum),
                              weight);
      };
      const double square_mm2 = mean(&InnovationSums::square_mm2);
      const double excess_mm2 = square_mm2 - mean(&InnovationSums::expected_mm2);
      field.push_back(
          {static_cast<float>(square_mm2), static_cast<float>(std::max(0.0, excess_mm2))});
    }
    return InnovationField(std::move(field));
  }

  static PosedCamera cameraOf(const Observation& observation) {
    return posedCamera(observation.left, observation.world_from_left);
  }
  template <class T>
  void send(T* to, const std::vector<T>& from) {
    if (!from.empty()) machine_.toDevice(to, from.data(), from.size() * sizeof(T));
  }

  Memory frame_memory_, model_memory_, graph_memory_;
  OwnRasters<Machine> own_rasters_;
  Machine machine_;
  ComparisonPasses<typename Machine::Executor> passes_;
  ComparisonFrameLayout frame_;
  ComparisonModelLayout model_;
  ComparisonGraphLayout graph_;
  std::size_t capacity_ = 0;
  std::vector<std::uint8_t> seen_;
  std::vector<char> totals_;
  std::shared_ptr<const SharedRasters> shared_;
  std::shared_ptr<ModelHome<Machine>> shared_home_;
  ModelHome<Machine> own_home_;
};

}  // namespace softscope::cuda
