// tests/bench/bench_times.h: percentiles of times, and the exit code of an error.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "core/error.h"

namespace softscope::bench {

inline double nowMs() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

inline double atShare(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}
inline void print(const char* what, const std::vector<double>& values) {
  std::printf("  %-36s p50 %.3f  p95 %.3f  p99 %.3f  max %.3f ms\n", what, atShare(values, 0.5),
              atShare(values, 0.95), atShare(values, 0.99), atShare(values, 1));
}

/// The exit code that `work()` returns; that of an error otherwise.
template <class Work>
int orErrorCode(const Work& work) {
  try {
    return work();
  } catch (const BackendError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}

}  // namespace softscope::bench
