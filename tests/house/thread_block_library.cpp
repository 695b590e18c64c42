// tests/house/thread_block_library.cpp: keeps memory in a thread-local block, as drivers do.
#include <cstdlib>

namespace {
thread_local char* held = nullptr;
thread_local char block[32] = {};  // with `held` 40 bytes: 64 of them fit a page, one at its start
}  // namespace

/// Memory that only this thread's block points to.
extern "C" const char* holdInThreadBlock() {
  if (held == nullptr) held = static_cast<char*>(std::malloc(1000));
  block[0] = 1;
  return block;
}
