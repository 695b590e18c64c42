// cuda/model/model_home.h: the model in memory of the device, for all stages that work on it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "cuda/device/copy_kernel.h"
#include "cuda/device/reset_kernel.h"
#include "cuda/device/uplink.h"
#include "cuda/model/model_layout.h"
#include "fusion/model_parts.h"
#include "fusion/sight.h"

namespace softscope::cuda {

/// Two sets of arrays: the model, and room for what replaces it. The stages take turns: each has
/// waited for its own work when another begins. Machine: as WarpRun has it.
template <class Machine>
class ModelHome {
 public:
  /// The host's model is not that of the device any more, in these parts.
  void changed(ModelParts parts) {
    stale_ |= parts;
    if ((parts & kModelShape) != 0) forgetFrame();
  }

  /// In these parts, the device's model replaces that of the host.
  void isAhead(ModelParts parts) { stale_ &= ~parts; }

  /// Copies those of the `parts` that changed on the host. `machine`: the caller's, or what has its
  /// executor(), toDevice() and wait(). There is room for `more` points then.
  template <class Link>
  const ModelArrays& bring(const PointModel& model, ModelParts parts, std::size_t more,
                           Link& machine) {
    reserve(model.size() + more, machine);
    count_ = model.size();
    const ModelParts due = stale_ & parts;
    stale_ &= ~parts;
    const ModelArrays& to = arrays();
    if ((due & kModelShape) != 0) {
      uplink_.add(to.positions_mm, model.positions_mm);
      uplink_.add(to.normals, model.normals);
    }
    if ((due & kModelLooks) != 0) {
      uplink_.add(to.colours, model.colours);
      uplink_.add(to.anchors, model.anchors);
      uplink_.add(to.weights, model.weights);
    }
    if ((due & kModelBindings) != 0) uplink_.add(to.bindings, model.bindings);
    uplink_.send(machine);
    return to;
  }

  const ModelArrays& arrays() const { return sets_[current_]; }
  const ModelArrays& other() const { return sets_[1 - current_]; }
  /// The other set holds the model now, of that many points.
  void swap(std::size_t count) {
    current_ = 1 - current_;
    count_ = count;
    forgetFrame();
  }
  /// How the points compare with the frame at hand, on the device; null where that is not known, or
  /// not any more.
  void setSights(const PointSight* sights) { sights_ = sights; }
  const PointSight* sights() const { return sights_; }
  /// Non-zero for the points that the frame at hand shows; null as above.
  void setSeen(const std::uint8_t* seen) { seen_ = seen; }
  const std::uint8_t* seen() const { return seen_; }
  void forgetFrame() {
    sights_ = nullptr;
    seen_ = nullptr;
  }
  std::size_t count() const { return count_; }
  std::size_t capacity() const { return capacity_; }

 private:
  using Memory = typename Machine::Memory;

  /// As much again as there are points, so that a growing model rarely reallocates.
  template <class Link>
  void reserve(std::size_t points, Link& machine) {
    if (points <= capacity_) return;
    const std::size_t capacity = points + count_;
    Arena counting;
    for (int set = 0; set < 2; ++set) ModelArrays(counting, capacity);
    Memory memory(counting.bytes(), "memory for the model");
    Arena arena(memory.data());
    const ModelArrays to(arena, capacity), spare(arena, capacity);
    ResetKernel reset;  // arrays of bytes are copied in whole words
    reset.add(memory.data(), counting.bytes() / sizeof(std::uint32_t), 0);
    machine.executor().launch("reset", reset, reset.blocks());
    if (count_ > 0) {
      const ModelArrays& from = arrays();
      CopyKernel copy;
      copy.add(from.positions_mm, to.positions_mm, count_);
      copy.add(from.normals, to.normals, count_);
      copy.add(from.colours, to.colours, count_);
      copy.add(from.anchors, to.anchors, count_);
      copy.add(from.weights, to.weights, count_);
      copy.add(from.bindings, to.bindings, count_);
      machine.executor().launch("copy", copy, copy.blocks());
    }
    machine.wait();
    memory_ = std::move(memory);
    sets_[0] = to;
    sets_[1] = spare;
    current_ = 0;
    capacity_ = capacity;
  }

  Memory memory_;
  Uplink<Machine> uplink_;
  ModelArrays sets_[2];
  int current_ = 0;
  std::size_t count_ = 0, capacity_ = 0;
  ModelParts stale_ = kWholeModel;
  const PointSight* sights_ = nullptr;
  const std::uint8_t* seen_ = nullptr;
};

}  // namespace softscope::cuda
