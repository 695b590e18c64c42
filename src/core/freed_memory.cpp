#include "core/freed_memory.h"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <thread>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace softscope {
#ifdef __GLIBC__
namespace {

constexpr int kBytesPerMB = 1 << 20;

/// In the addresses that the heap grows into: they are taken now, their memory when it is used. A
/// system without large pages, or with a limit of addresses, changes nothing.
void askForLargePages() {
  constexpr int kHeapBytes = 512 * kBytesPerMB;
  constexpr std::uintptr_t kLargePageBytes = 2 * kBytesPerMB;
  mallopt(M_TOP_PAD, kHeapBytes);
  void* const first = std::malloc(kLargePageBytes);  // the heap grows for it
  const auto begin =
      (reinterpret_cast<std::uintptr_t>(first) / kLargePageBytes + 1) * kLargePageBytes;
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  std::free(first);
  mallopt(M_TOP_PAD, kBytesPerMB);
}

}  // namespace

void keepFreedMemory() {
  constexpr int kMostOnHeapBytes = 32 * kBytesPerMB;  // glibc allows no more; rasters are smaller
  mallopt(M_MMAP_THRESHOLD, kMostOnHeapBytes);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  if (std::thread::hardware_concurrency() <= kMostCoresOfOneHeap) mallopt(M_ARENA_MAX, 1);
  askForLargePages();
}
#else
void keepFreedMemory() {}
#endif

}  // namespace softscope
