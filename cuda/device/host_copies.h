// cuda/device/host_copies.h: large arrays of the host, copied by all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "core/parallel.h"

namespace softscope::cuda {

class HostCopies {
 public:
  void add(const void* from, void* to, std::size_t bytes) {
    for (std::size_t at = 0; at < bytes; at += kPieceBytes)
      pieces_.push_back({static_cast<const char*>(from) + at, static_cast<char*>(to) + at,
                         std::min(kPieceBytes, bytes - at)});
  }
  void copy() const {
    parallelRanges(static_cast<int>(pieces_.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const Piece& piece = pieces_[static_cast<std::size_t>(i)];
        std::memcpy(piece.to, piece.from, piece.bytes);
      }
    });
  }

 private:
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 18;  // worth a task
  struct Piece {
    const char* from;
    char* to;
    std::size_t bytes;
  };

  std::vector<Piece> pieces_;
};

}  // namespace softscope::cuda
