// cuda/frame/upload_run.h: frames copied ahead, on any machine.
#pragma once

#include <memory>
#include <utility>

#include "core/camera.h"
#include "core/error.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/device/shared_rasters.h"
#include "cuda/frame/raster_layout.h"
#include "fusion/frame_uploader.h"

namespace softscope::cuda {

/// Room for two frames: the one at hand, and the next. Machine: as WarpRun has it.
template <class Machine>
class UploadRun final : public FrameUploader {
 public:
  template <class... Arguments>
  UploadRun(const PinholeCamera& left, std::shared_ptr<SharedRasters> shared,
            Arguments&&... arguments)
      : left_(left),
        shared_(std::move(shared)),
        memory_(bytesFor(left), "memory for two frames"),
        machine_(std::forward<Arguments>(arguments)...) {
    Arena arena(memory_.data());
    for (Slot& slot : slots_) slot = Slot(arena, pixelsOf(left));
    ResetKernel reset;  // arrays of bytes are copied in whole words
    reset.add(memory_.data(), memory_.bytes() / sizeof(std::uint32_t), 0);
    machine_.executor().launch("reset", reset, reset.blocks());
    machine_.wait();
  }

  void upload(const Observation& frame, const Raster<PixelState>& states, const GrayImage& gray,
              const Mask& ignore) override {
    uploaded_ = {};
    if (frame.left.width_px != left_.width_px || frame.left.height_px != left_.height_px)
      throw Error("a frame of another camera than the one that was planned for");
    frame.validate();
    const Slot& to = slots_[1 - at_hand_];
    to.rasters.send(frame, states, machine_);
    RasterLayout::sendTo(to.match_gray, gray, machine_);
    RasterLayout::sendTo(to.ignore, ignore, machine_);
    machine_.wait();
    uploaded_ = {frame.depth.depth_mm.values.data(),
                 to.rasters.depth_mm,
                 frame.depth.sigma_mm.empty() ? nullptr : to.rasters.sigma_mm,
                 to.rasters.normals,
                 to.rasters.states,
                 frame.colour.empty() ? nullptr : to.rasters.colour,
                 gray.empty() ? nullptr : to.match_gray,
                 ignore.empty() ? nullptr : to.ignore};
  }
  void use(const DepthMap& depth) override {
    *shared_ = std::exchange(uploaded_, {});
    if (shared_->holds(depth.depth_mm.values.data()))
      at_hand_ = 1 - at_hand_;
    else
      *shared_ = {};
  }

 private:
  struct Slot {
    Slot() = default;
    Slot(Arena& arena, std::size_t pixels)
        : rasters(arena, pixels),
          match_gray(arena.array<std::uint8_t>(pixels)),
          ignore(arena.array<std::uint8_t>(pixels)) {}

    RasterLayout rasters;
    std::uint8_t *match_gray = nullptr, *ignore = nullptr;
  };
  static std::size_t pixelsOf(const PinholeCamera& left) {
    return static_cast<std::size_t>(left.width_px) * static_cast<std::size_t>(left.height_px);
  }
  static std::size_t bytesFor(const PinholeCamera& left) {
    Arena counting;
    for (int slot = 0; slot < 2; ++slot) Slot(counting, pixelsOf(left));
    return counting.bytes();
  }

  PinholeCamera left_;
  std::shared_ptr<SharedRasters> shared_;
  typename Machine::Memory memory_;
  Machine machine_;
  Slot slots_[2];
  int at_hand_ = 0;
  SharedRasters uploaded_;  // where it was not used yet
};

}  // namespace softscope::cuda
