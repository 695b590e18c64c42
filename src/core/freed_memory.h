// src/core/freed_memory.h: freed memory, kept by the program instead of returned to the system.
#pragma once

namespace softscope {

/// On more, threads wait for each other at a single heap (docs/benchmarks.md).
inline constexpr unsigned kMostCoresOfOneHeap = 4;

/// Large arrays of a frame then take the memory of those before, instead of new pages that the
/// system clears first; on up to kMostCoresOfOneHeap also that of other threads. The first 512 MB
/// come in large pages where the system has them. Without effect where the C library is not glibc.
/// For a program's start.
void keepFreedMemory();

}  // namespace softscope
