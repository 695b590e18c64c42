// cuda/device/downlink.h: arrays of the device to vectors of the host, through pinned memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "cuda/device/arena.h"

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
    if (pinned_.bytes() < counting.bytes()) {
      pinned_ = typename Machine::Pinned();
      pinned_ = typename Machine::Pinned(counting.bytes() + counting.bytes() / 2,
                                         "pinned memory for the model");
    }
    Arena arena(pinned_.data());
    std::vector<const char*> arrived;
    const std::vector<Part> parts = std::exchange(parts_, {});
    for (const Part& part : parts) {
      char* to = arena.array<char>(part.bytes);
      if (part.bytes > 0) machine.fromDevice(to, part.from, part.bytes);
      arrived.push_back(to);
    }
    machine.wait();
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      char* to = static_cast<char*>(parts[i].makeRoom());
      for (std::size_t at = 0; at < parts[i].bytes; at += kPieceBytes)
        pieces.push_back({arrived[i] + at, to + at, std::min(kPieceBytes, parts[i].bytes - at)});
    }
    parallelRanges(static_cast<int>(pieces.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const Piece& piece = pieces[static_cast<std::size_t>(i)];
        std::memcpy(piece.to, piece.from, piece.bytes);
      }
    });
  }

 private:
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 18;  // worth a task
  struct Part {
    const void* from;
    std::size_t bytes;
    std::function<void*()> makeRoom;
  };
  struct Piece {
    const char* from;
    char* to;
    std::size_t bytes;
  };

  typename Machine::Pinned pinned_;
  std::vector<Part> parts_;
};

}  // namespace softscope::cuda
