// cuda/device/grown_memory.h: memory that grows with what it holds.
#pragma once

#include <cstddef>

namespace softscope::cuda {

/// Room for so many bytes; what was there is lost where it grows. Half more is reserved, so that
/// memory of a growing model or graph is rarely reallocated, and the old is given back first.
template <class Memory>
void growTo(std::size_t bytes, const char* what, Memory* memory) {
  if (memory->bytes() >= bytes) return;
  *memory = Memory();
  *memory = Memory(bytes + bytes / 2, what);
}

}  // namespace softscope::cuda
