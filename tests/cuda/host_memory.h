// tests/cuda/host_memory.h: memory of a layout for the host executor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cuda/device/arena.h"

namespace softscope::test {

/// Aligned as the device's, and filled with garbage at first.
class HostMemory {
 public:
  explicit HostMemory(std::size_t bytes) : bytes_(bytes + cuda::Arena::kAlignment, '\xA5') {}
  void* data() {
    const auto place = reinterpret_cast<std::uintptr_t>(bytes_.data());
    return bytes_.data() + (cuda::Arena::kAlignment - place % cuda::Arena::kAlignment);
  }

 private:
  std::vector<char> bytes_;
};

}  // namespace softscope::test
