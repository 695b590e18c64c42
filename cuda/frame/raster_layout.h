// cuda/frame/raster_layout.h: the rasters of a frame, planned from the number of its pixels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image.h"
#include "cuda/device/arena.h"
#include "fusion/observation.h"

namespace softscope::cuda {

/// Members of an Observation, and the states of its pixels.
struct RasterLayout {
  RasterLayout() = default;
  RasterLayout(Arena& arena, std::size_t pixels) {
    depth_mm = arena.array<float>(pixels);
    sigma_mm = arena.array<float>(pixels);
    normals = arena.array<Eigen::Vector3f>(pixels);
    colour = arena.array<Rgb8>(pixels);
    states = arena.array<PixelState>(pixels);
  }

  template <class Machine>
  void send(const Observation& frame, const Raster<PixelState>& of_pixels,
            const Machine& machine) const {
    sendTo(depth_mm, frame.depth.depth_mm, machine);
    sendTo(sigma_mm, frame.depth.sigma_mm, machine);
    sendTo(normals, frame.normals, machine);
    sendTo(colour, frame.colour, machine);
    sendTo(states, of_pixels, machine);
  }
  template <class T, class Machine>
  static void sendTo(T* to, const Raster<T>& from, const Machine& machine) {
    if (!from.empty()) machine.toDevice(to, from.values.data(), from.size() * sizeof(T));
  }

  float *depth_mm = nullptr, *sigma_mm = nullptr;
  Eigen::Vector3f* normals = nullptr;
  Rgb8* colour = nullptr;
  PixelState* states = nullptr;
};

/// Room for the rasters of a stage that finds none on the device. Machine: as WarpRun has it.
template <class Machine>
class OwnRasters {
 public:
  /// The caller waits for the machine before the frame changes.
  const RasterLayout& send(const Observation& frame, const Raster<PixelState>& states,
                           const Machine& machine) {
    const std::size_t pixels = states.size();
    Arena counting;
    const RasterLayout planned(counting, pixels);
    if (memory_.bytes() < counting.bytes())
      memory_ = typename Machine::Memory(counting.bytes(), "memory for a frame");
    Arena arena(memory_.data());
    rasters_ = RasterLayout(arena, pixels);
    rasters_.send(frame, states, machine);
    return rasters_;
  }

 private:
  typename Machine::Memory memory_;
  RasterLayout rasters_;
};

}  // namespace softscope::cuda
