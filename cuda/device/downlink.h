// cuda/device/downlink.h: arrays of the device to vectors of the host, through pinned memory.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "cuda/device/arena.h"
#include "cuda/device/grown_memory.h"
#include "cuda/device/host_copies.h"

namespace softscope::cuda {

/// Machine: as WarpRun has it, with Pinned memory of the host.
template <class Machine>
class Downlink {
 public:
  /// The vector gets that size and its values with fetch().
  template <class T>
  void add(const T* from, std::size_t count, std::vector<T>* to) {
    parts_.push_back({from, count * sizeof(T), [to, count] {
                        to->resize(count);
                        return static_cast<void*>(to->data());
                      }});
  }
  /// Everything that was added since the last time; the vectors are as they were where the device
  /// fails.
  void fetch(Machine& machine) {
    Arena counting;
    for (const Part& part : parts_) counting.array<char>(part.bytes);
    growTo(counting.bytes(), "pinned memory for the model", &pinned_);
    Arena arena(pinned_.data());
    std::vector<const char*> arrived;
    const std::vector<Part> parts = std::exchange(parts_, {});
    for (const Part& part : parts) {
      char* to = arena.array<char>(part.bytes);
      if (part.bytes > 0) machine.fromDevice(to, part.from, part.bytes);
      arrived.push_back(to);
    }
    machine.wait();
    HostCopies copies;
    for (std::size_t i = 0; i < parts.size(); ++i)
      copies.add(arrived[i], parts[i].makeRoom(), parts[i].bytes);
    copies.copy();
  }

 private:
  struct Part {
    const void* from;
    std::size_t bytes;
    std::function<void*()> makeRoom;
  };

  typename Machine::Pinned pinned_;
  std::vector<Part> parts_;
};

}  // namespace softscope::cuda
