// cuda/device/uplink.h: vectors of the host to arrays of the device, through pinned memory.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "cuda/device/arena.h"
#include "cuda/device/grown_memory.h"
#include "cuda/device/host_copies.h"

namespace softscope::cuda {

/// From pageable memory, the driver copies in one thread. Machine: as WarpRun has it, with Pinned
/// memory of the host.
template <class Machine>
class Uplink {
 public:
  template <class T>
  void add(T* to, const std::vector<T>& from) {
    if (!from.empty()) parts_.push_back({to, from.data(), from.size() * sizeof(T)});
  }
  /// Everything that was added since the last time; the device has it then. `machine`: has
  /// toDevice() and wait().
  template <class Link>
  void send(Link& machine) {
    const std::vector<Part> parts = std::exchange(parts_, {});
    if (parts.empty()) return;
    Arena counting;
    for (const Part& part : parts) counting.array<char>(part.bytes);
    growTo(counting.bytes(), "pinned memory for the model", &pinned_);
    Arena arena(pinned_.data());
    HostCopies copies;
    std::vector<char*> staged;
    for (const Part& part : parts) {
      staged.push_back(arena.array<char>(part.bytes));
      copies.add(part.from, staged.back(), part.bytes);
    }
    copies.copy();
    for (std::size_t i = 0; i < parts.size(); ++i)
      machine.toDevice(parts[i].to, staged[i], parts[i].bytes);
    machine.wait();  // other stages send too, on streams of their own
  }

 private:
  struct Part {
    void* to;
    const void* from;
    std::size_t bytes;
  };

  typename Machine::Pinned pinned_;
  std::vector<Part> parts_;
};

}  // namespace softscope::cuda
