// cuda/device/arena.h: many arrays in one allocation, planned in advance.
#pragma once

#include <cstddef>

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Allocates parts of one block of memory in order. Without a base it only counts:
/// a layout is computed twice, first for bytes(), then on memory of that size.
class Arena {
 public:
  static constexpr std::size_t kAlignment = 256;

  explicit Arena(void* base = nullptr) : base_(static_cast<char*>(base)) {}

  template <class T>
  T* array(std::size_t count) {
    const std::size_t at = bytes_;
    bytes_ += (count * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;
    return base_ == nullptr ? nullptr : reinterpret_cast<T*>(base_ + at);
  }
  template <class T>
  View<T> image(int width, int height) {
    return {array<T>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)), width,
            height, width};
  }
  std::size_t bytes() const { return bytes_; }

 private:
  char* base_;
  std::size_t bytes_ = 0;
};

}  // namespace softscope::cuda
