// cuda/frame/survey_run.h: frames surveyed ahead of the stages, on any machine.
#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "core/camera.h"
#include "core/error.h"
#include "cuda/device/copy_kernel.h"
#include "cuda/device/host_copies.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/frame/pixel_state_body.h"
#include "cuda/frame/raster_layout.h"
#include "cuda/frame/relief.h"
#include "cuda/frame/tissue_count.h"
#include "fusion/frame_survey.h"

namespace softscope::cuda {

/// Room for the frame at hand, and for those that wait. Machine: as WarpRun has it.
template <class Machine>
class SurveyRun final : public FrameSurvey {
 public:
  template <class... Arguments>
  SurveyRun(const PinholeCamera& left, std::shared_ptr<SharedFrames> frames,
            const Arguments&... arguments)
      : left_(left),
        frames_(std::move(frames)),
        memory_(bytesFor<Rooms>(left), "memory for frames"),
        staging_memory_(bytesFor<Staging>(left), "pinned memory for the images of a frame"),
        machine_(arguments...),
        beside_(arguments...) {
    Arena arena(memory_.data());
    rooms_ = Rooms(arena, pixelsOf(left));
    ResetKernel reset;  // arrays of bytes are copied in whole words
    reset.add(memory_.data(), memory_.bytes() / sizeof(std::uint32_t), 0);
    launch("reset", reset);
    machine_.wait();
  }

  void show(const ColourImage& left, const Mask& not_tissue, const GrayImage& gray,
            const Mask& ignore) override {
    machine_.wait();  // the pinned memory is free, whatever became of the frame before
    for (const auto& [width, height] : {std::pair(left.width_px, left.height_px),
                                        std::pair(not_tissue.width_px, not_tissue.height_px)})
      if (width != 0 && (width != left_.width_px || height != left_.height_px))
        throw Error("a frame of another camera than the one that was planned for");
    takeFreeSlot();
    const Slot& to = *slot_;
    Arena arena(staging_memory_.data());
    const Staging staging(arena, pixelsOf(left_));
    HostCopies copies;
    stage(left, staging.colour, &copies);
    stage(not_tissue, staging.not_tissue, &copies);
    stage(gray, staging.gray, &copies);
    stage(ignore, staging.ignore, &copies);
    copies.copy();
    send(to.rasters.colour, staging.colour, left.size());
    send(to.not_tissue, staging.not_tissue, not_tissue.size());
    send(to.match_gray, staging.gray, gray.size());
    send(to.ignore, staging.ignore, ignore.size());
    shown_ = {};
    shown_.colour = left.empty() ? nullptr : to.rasters.colour;
    shown_.match_gray = gray.empty() ? nullptr : to.match_gray;
    shown_.ignore = ignore.empty() ? nullptr : to.ignore;
  }

  TissueDepths depthsOf(const Observation& frame) override {
    takeDepth(frame);
    count();
    TissueTotals totals;
    machine_.fromDevice(&totals, rooms_.totals, sizeof totals);
    machine_.wait();
    TissueDepths found;
    found.tissue_px = totals.tissue_px;
    found.measured_px = totals.measured_px;
    found.precise_px = totals.precise_px;
    if (found.measured_px == 0) return found;
    found.median_mm = bitsAsFloat(totals.medians[0].bits);
    if (shown_.sigma_mm != nullptr) found.median_sigma_mm = bitsAsFloat(totals.medians[1].bits);
    return found;
  }

  Raster<PixelState> statesOf(const Observation& frame, const PixelOptions& options) override {
    options.validate();
    const Slot& to = *slot_;
    const PixelStateBody classify{{shown_.depth_mm, shown_.sigma_mm, shown_.normals, shown_.colour},
                                  posedCamera(frame.left, frame.world_from_left),
                                  frame.mask.empty() ? nullptr : to.not_tissue,
                                  static_cast<float>(options.max_sigma_mm),
                                  to.rasters.states};
    launchPerPixel(machine_, "pixel states", classify);
    Raster<PixelState> states(left_.width_px, left_.height_px);
    machine_.fromDevice(states.values.data(), to.rasters.states, states.size());
    machine_.wait();
    shown_.host_depth_mm = frame.depth.depth_mm.values.data();
    shown_.states = to.rasters.states;
    frames_->add(std::exchange(shown_, {}));
    return states;
  }

  void use(const DepthMap& depth) override { frames_->use(depth.depth_mm.values.data()); }

  Raster<float> reliefOf(const DepthMap& depth, double focal_baseline_px_mm) override {
    const SharedRasters& frame = frames_->at_hand;
    if (!frame.holds(depth.depth_mm.values.data())) return {};
    const int width = left_.width_px, height = left_.height_px;
    const ReliefLayout& at = rooms_.relief;
    const auto perPixel = [&](const char* name, const auto& body) {
      launchPerPixel(beside_, name, body);
    };
    perPixel("relief steps",
             ReliefStepsBody{frame.depth_mm, at, width, static_cast<float>(focal_baseline_px_mm)});
    perPixel("relief windows", ReliefExtentsBody{at, width, height});
    perPixel("relief rows", ReliefRowsBody<ReliefSides::kEven>{at, width});
    perPixel("relief bends", ReliefBendBody{at, width});
    perPixel("relief rows", ReliefRowsBody<ReliefSides::kBoth>{at, width});
    perPixel("relief error", ReliefErrorBody{at, width});
    Raster<float> error_px(width, height);
    beside_.fromDevice(error_px.values.data(), at.error_px, error_px.size() * sizeof(float));
    beside_.wait();
    return error_px;
  }

 private:
  struct Slot {
    Slot() = default;
    Slot(Arena& arena, std::size_t pixels)
        : rasters(arena, pixels),
          match_gray(arena.array<std::uint8_t>(pixels)),
          ignore(arena.array<std::uint8_t>(pixels)),
          not_tissue(arena.array<std::uint8_t>(pixels)) {}

    RasterLayout rasters;
    std::uint8_t *match_gray = nullptr, *ignore = nullptr, *not_tissue = nullptr;
  };

  /// What the host shows of a frame, on its way.
  struct Staging {
    Staging(Arena& arena, std::size_t pixels)
        : colour(arena.array<Rgb8>(pixels)),
          not_tissue(arena.array<std::uint8_t>(pixels)),
          gray(arena.array<std::uint8_t>(pixels)),
          ignore(arena.array<std::uint8_t>(pixels)) {}

    Rgb8* colour;
    std::uint8_t *not_tissue, *gray, *ignore;
  };

  struct Rooms {
    Rooms() = default;
    Rooms(Arena& arena, std::size_t pixels) {
      for (Slot& slot : slots) slot = Slot(arena, pixels);
      counts = arena.array<std::uint32_t>(TissueTotals::kSearches * kRankCounts);
      totals = arena.array<TissueTotals>(1);
      relief = ReliefLayout(arena, pixels);
    }

    Slot slots[SharedFrames::kWaiting + 1];
    std::uint32_t* counts = nullptr;
    TissueTotals* totals = nullptr;
    ReliefLayout relief;
  };
  template <class Layout>
  static std::size_t bytesFor(const PinholeCamera& left) {
    Arena counting;
    Layout(counting, pixelsOf(left));
    return counting.bytes();
  }
  static std::size_t pixelsOf(const PinholeCamera& left) {
    return static_cast<std::size_t>(left.width_px) * static_cast<std::size_t>(left.height_px);
  }
  template <class T>
  static void stage(const Raster<T>& from, T* staged, HostCopies* copies) {
    copies->add(from.values.data(), staged, from.size() * sizeof(T));
  }
  /// From pinned memory: the caller does not wait. It is free again once depthsOf() has waited.
  template <class T>
  void send(T* to, const T* staged, std::size_t count) {
    if (count > 0) machine_.toDevice(to, staged, count * sizeof(T));
  }
  void takeFreeSlot() {
    frames_->makeRoom();
    slot_ = std::find_if(std::begin(rooms_.slots), std::end(rooms_.slots),
                         [&](const Slot& slot) { return !frames_->holds(slot.rasters.states); });
  }

  /// Depth, sigma and normals, from where the stage of stereo left them or from the host. In the
  /// first case those of the host may be on their way.
  void takeDepth(const Observation& frame) {
    const RasterLayout& to = slot_->rasters;
    const SharedRasters measured = std::exchange(frames_->measured, {});
    if (measured.holds(frame.depth.depth_mm.values.data())) {
      CopyKernel copy;
      copy.add(measured.depth_mm, to.depth_mm, pixelsOf(left_));
      copy.add(measured.sigma_mm, to.sigma_mm, pixelsOf(left_));
      copy.add(measured.normals, to.normals, pixelsOf(left_));
      launch("copy depth", copy);
    } else {
      frame.validate();
      RasterLayout::sendTo(to.depth_mm, frame.depth.depth_mm, machine_);
      RasterLayout::sendTo(to.sigma_mm, frame.depth.sigma_mm, machine_);
      RasterLayout::sendTo(to.normals, frame.normals, machine_);
    }
    shown_.depth_mm = to.depth_mm;
    shown_.sigma_mm = frame.depth.sigma_mm.empty() ? nullptr : to.sigma_mm;
    shown_.normals = to.normals;
  }
  void count() {
    ResetKernel reset;
    reset.add(rooms_.counts, TissueTotals::kSearches * kRankCounts, 0);
    reset.add(rooms_.totals, sizeof(TissueTotals) / sizeof(std::uint32_t), 0);
    launch("reset", reset);
    const TissueRasters rasters{shown_.depth_mm, shown_.sigma_mm, slot_->not_tissue,
                                static_cast<int>(pixelsOf(left_))};
    for (int step = 0; step < kRankSteps; ++step) {
      launch("count depths", TissueCountKernel{rasters, rooms_.counts, rooms_.totals, step});
      launch("pick median", PickRankKernel<UpperMedian>{rooms_.counts, rooms_.totals->medians, step,
                                                        TissueTotals::kSearches});
    }
  }
  template <class Body>
  void launchPerPixel(Machine& machine, const char* name, const Body& body) const {
    const PixelKernel<Body> kernel{body, left_.width_px, left_.height_px};
    machine.executor().launch(name, kernel, kernel.grid());
  }
  template <class Kernel>
  void launch(const char* name, const Kernel& kernel) {
    machine_.executor().launch(name, kernel, kernel.blocks());
  }

  PinholeCamera left_;
  std::shared_ptr<SharedFrames> frames_;
  typename Machine::Memory memory_;
  typename Machine::Pinned staging_memory_;
  Machine machine_, beside_;  // of the frame that is surveyed, and of the one at hand
  Rooms rooms_;
  const Slot* slot_ = rooms_.slots;  // of the frame under way
  SharedRasters shown_;              // of it
};

}  // namespace softscope::cuda
