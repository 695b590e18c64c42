// tests/cuda/fusion_run.h: stage 7 by the kernels of fusion_kernels.h, on any machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "fusion/point_fusion.h"
#include "fusion/point_insertion.h"
#include "fusion_kernels.h"

namespace softscope::test {

/// What the stage starts from.
struct FusionInputs {
  const Observation& observation;
  const PointModel& model;
  const WarpGraph& graph;
  const ModelComparison& comparison;
  const InsertionMemory& memory;
  const FusionOptions& options;
};

/// What it leaves. Counts: points of the model before density is kept, and those of them that are
/// new.
struct FusionResult {
  std::vector<PixelState> states;
  std::vector<float> unexplained_mm;
  std::vector<ModelPoint> points;
  int before_density = 0, inserted = 0;
};

/// Machine: as WarpRun has it.
template <class Machine>
class FusionRun {
 public:
  template <class... Arguments>
  explicit FusionRun(Arguments&&... arguments) : machine_(std::forward<Arguments>(arguments)...) {}

  FusionResult update(const FusionInputs& from) {
    frame_ = fusingFrame(from.observation, from.comparison.gain, from.options.points,
                         from.options.colour);
    frame_.rasters = sendRasters(from.observation);
    FusionResult result;
    PixelState* states = findStates(from);
    result.states = fetch(states, pixels());
    const FusionPoints model = sendModel(from);
    launch("fuse", FuseKernel{frame_, model}, model.count);
    result.points = fetch(model.points, from.model.size());
    insert(from, model, states, &result);
    keepDensity(from.options.density, &result.points);
    return result;
  }

 private:
  using Memory = typename Machine::Memory;

  std::size_t pixels() const {
    return static_cast<std::size_t>(frame_.camera.width_px) *
           static_cast<std::size_t>(frame_.camera.height_px);
  }
  template <class T>
  T* allocate(std::size_t count) {
    memory_.emplace_back((count + 1) * sizeof(T), "memory of a test");
    return static_cast<T*>(memory_.back().data());
  }
  template <class T>
  T* send(const std::vector<T>& values) {
    T* to = allocate<T>(values.size());
    if (!values.empty()) machine_.toDevice(to, values.data(), values.size() * sizeof(T));
    machine_.wait();
    return to;
  }
  template <class T>
  std::vector<T> fetch(const T* from, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) machine_.fromDevice(values.data(), from, count * sizeof(T));
    machine_.wait();
    return values;
  }
  template <class Kernel>
  void launch(const char* name, const Kernel& kernel, int count) {
    machine_.executor().launch(name, kernel, {cuda::blocksFor(count, Kernel::kThreads), 1, 1});
  }
  template <class Body>
  void forEachPixel(const char* name, const Body& body) {
    const cuda::PixelKernel<Body> kernel{body, frame_.camera.width_px, frame_.camera.height_px};
    machine_.executor().launch(name, kernel, kernel.grid());
  }

  FrameRasters sendRasters(const Observation& frame) {
    return {send(frame.depth.depth_mm.values),
            frame.depth.sigma_mm.empty() ? nullptr : send(frame.depth.sigma_mm.values),
            send(frame.normals.values), frame.colour.empty() ? nullptr : send(frame.colour.values)};
  }
  PixelState* findStates(const FusionInputs& from) {
    const Mask& mask = from.observation.mask;
    PixelState* states = allocate<PixelState>(pixels());
    forEachPixel("states", StateBody{frame_.rasters, frame_.camera,
                                     mask.empty() ? nullptr : send(mask.values),
                                     static_cast<float>(from.options.pixels.max_sigma_mm), states});
    return states;
  }
  FusionPoints sendModel(const FusionInputs& from) {
    const PointModel& model = from.model;
    std::vector<ModelPoint> points;
    for (std::size_t i = 0; i < model.size(); ++i)
      points.push_back({model.positions_mm[i], model.normals[i], model.colours[i], model.anchors[i],
                        model.weights[i]});
    std::vector<std::uint8_t> anchored(pixels());
    for (std::size_t pixel = 0; pixel < anchored.size(); ++pixel)
      anchored[pixel] = from.comparison.anchored.at(static_cast<std::int32_t>(pixel));
    const std::vector<Innovation>& innovation = from.comparison.innovation.nodes();
    return {static_cast<int>(points.size()),
            send(points),
            send(model.bindings),
            send(from.comparison.visibility.points),
            send(from.graph.stencils),
            static_cast<int>(from.graph.stencils.size()),
            send(from.graph.positions_mm),
            innovation.empty() ? nullptr : send(innovation),
            send(anchored)};
  }

  /// Adds the first new point of every cell, in the image's order.
  void insert(const FusionInputs& from, const FusionPoints& model, const PixelState* states,
              FusionResult* result) {
    std::uint32_t* nearest = send(std::vector<std::uint32_t>(
        pixels(), cuda::floatAsBits(std::numeric_limits<float>::infinity())));
    launch("draw", DrawKernel{model, frame_.camera, nearest}, model.count);
    float* unexplained_mm = allocate<float>(pixels());
    CellKey* cells = allocate<CellKey>(pixels());
    ModelPoint* points = send(std::vector<ModelPoint>(pixels()));
    const bool at_once = !from.options.insertion.confirm || from.model.empty();
    forEachPixel("insert",
                 InsertBody{frame_, insertionLimits(from.options.insertion), sendLast(from.memory),
                            at_once, states, nearest, unexplained_mm, cells, points});
    result->unexplained_mm = fetch(unexplained_mm, pixels());
    const std::vector<ModelPoint> candidates = fetch(points, pixels());
    for (const std::int32_t pixel : firstOfCells(fetch(cells, pixels()))) {
      result->points.push_back(candidates[static_cast<std::size_t>(pixel)]);
      ++result->inserted;
    }
    result->before_density = static_cast<int>(result->points.size());
  }
  LastUnexplained sendLast(const InsertionMemory& memory) {
    const Raster<float>& depth_mm = memory.unexplained_mm;
    return {send(depth_mm.values), depth_mm.width_px, depth_mm.height_px,
            posedCamera(memory.left, memory.world_from_left)};
  }

  /// Indices of what lies in a cell, by cell, and within a cell in their order.
  static std::vector<std::int32_t> byCell(const std::vector<CellKey>& cells) {
    std::vector<std::int32_t> order;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i] != kNoCell) order.push_back(static_cast<std::int32_t>(i));
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return cells[static_cast<std::size_t>(a)] < cells[static_cast<std::size_t>(b)];
    });
    return order;
  }
  /// Where cells begin in that order, and the end of the last.
  static std::vector<std::int32_t> beginsOf(const std::vector<std::int32_t>& order,
                                            const std::vector<CellKey>& cells) {
    std::vector<std::int32_t> begins;
    for (std::size_t k = 0; k < order.size(); ++k)
      if (k == 0 || cells[static_cast<std::size_t>(order[k])] !=
                        cells[static_cast<std::size_t>(order[k - 1])])
        begins.push_back(static_cast<std::int32_t>(k));
    begins.push_back(static_cast<std::int32_t>(order.size()));
    return begins;
  }
  static std::vector<std::int32_t> firstOfCells(const std::vector<CellKey>& cells) {
    const std::vector<std::int32_t> order = byCell(cells), begins = beginsOf(order, cells);
    std::vector<std::int32_t> first;
    for (std::size_t cell = 0; cell + 1 < begins.size(); ++cell)
      first.push_back(order[static_cast<std::size_t>(begins[cell])]);
    std::sort(first.begin(), first.end());
    return first;
  }

  void keepDensity(const DensityOptions& options, std::vector<ModelPoint>* points) {
    const int count = static_cast<int>(points->size());
    ModelPoint* on_device = send(*points);
    CellKey* cells = allocate<CellKey>(points->size());
    launch("cells",
           DensityCellKernel{on_device, count, frame_.camera, static_cast<float>(options.cell_mm),
                             cells},
           count);
    const std::vector<CellKey> keys = fetch(cells, points->size());
    const std::vector<std::int32_t> order = byCell(keys), begins = beginsOf(order, keys);
    const int used = static_cast<int>(begins.size()) - 1;
    const double angle_rad = DensityOptions::kMaxAngleDeg * M_PI / 180;
    std::uint8_t* stays = send(std::vector<std::uint8_t>(points->size(), 0));
    launch("merge",
           MergeKernel{on_device, send(order), send(begins), used,
                       static_cast<float>(std::cos(angle_rad)),
                       allocate<std::int32_t>(order.size()), stays},
           used);
    const std::vector<ModelPoint> merged = fetch(on_device, points->size());
    const std::vector<std::uint8_t> kept = fetch(stays, points->size());
    points->clear();
    for (std::size_t i = 0; i < merged.size(); ++i)
      if (kept[i] != 0) points->push_back(merged[i]);
  }

  std::vector<Memory> memory_;
  Machine machine_;
  FusingFrame frame_;
};

}  // namespace softscope::test
