// cuda/device/copy_kernel.h: copies within the device, of arrays whose numbers are known on the
// host.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Copies several arrays in one launch; they do not overlap, and begin at multiples of 4 bytes.
struct CopyKernel {
  static constexpr int kThreads = 256, kPhases = 1, kMost = 8, kBlocks = 128;
  using Shared = Nothing;
  using Local = Nothing;
  struct Part {
    const std::uint32_t* from;
    std::uint32_t* to;
    std::size_t words;
  } parts[kMost];
  int part_count = 0;

  /// Both have room for whole words.
  template <class T>
  void add(const T* from, T* to, std::size_t count) {
    parts[part_count++] = {reinterpret_cast<const std::uint32_t*>(from),
                           reinterpret_cast<std::uint32_t*>(to), (count * sizeof(T) + 3) / 4};
  }
  Grid blocks() const { return {kBlocks, part_count, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const Part& part = parts[at.y];
    for (std::size_t i = static_cast<std::size_t>(at.x * kThreads + at.thread); i < part.words;
         i += kThreads * kBlocks)
      part.to[i] = part.from[i];
  }
};

}  // namespace softscope::cuda
