// cuda/device/reset_kernel.h: initial values of counters and accumulators.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Sets several arrays of 4-byte words in one launch.
struct ResetKernel {
  static constexpr int kThreads = 256, kPhases = 1, kMost = 6, kBlocks = 128;
  using Shared = Nothing;
  using Local = Nothing;
  struct Part {
    void* words;
    std::size_t count;
    std::uint32_t value;
  } parts[kMost];
  int part_count = 0;

  void add(void* words, std::size_t count, std::uint32_t value) {
    parts[part_count++] = {words, count, value};
  }
  Grid blocks() const { return {kBlocks, part_count, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const Part& part = parts[at.y];
    for (std::size_t i = static_cast<std::size_t>(at.x * kThreads + at.thread); i < part.count;
         i += kThreads * kBlocks)
      static_cast<std::uint32_t*>(part.words)[i] = part.value;
  }
};

}  // namespace softscope::cuda
