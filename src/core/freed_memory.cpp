#include "core/freed_memory.h"

#include <cstdlib>
#include <limits>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace softscope {

void keepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kMostOnHeapBytes = 32 << 20;  // the largest that glibc allows; rasters are smaller
  mallopt(M_MMAP_THRESHOLD, kMostOnHeapBytes);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace softscope
