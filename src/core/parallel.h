// src/core/parallel.h: parallel loops with results independent of the number of threads.
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace softscope {

/// Calls body(begin, end) over disjoint ranges that cover [0, count). Deterministic
/// if body writes only to its own range. `grain`: smallest range per task.
void parallelRanges(int count, int grain, const std::function<void(int begin, int end)>& body);

/// Grain of loops over a point model.
inline constexpr int kPointsPerTask = 4096;

/// Calls body(begin, end, &found) over disjoint ranges that cover [0, count); all that was found,
/// in the order of the ranges.
std::vector<int> parallelFind(
    int count, int grain,
    const std::function<void(int begin, int end, std::vector<int>* found)>& body);

/// Calls body(v) for every row v of [0, rows).
template <class Body>
void parallelRows(int rows, const Body& body) {
  parallelRanges(rows, 8, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) body(v);
  });
}

/// Calls both, in parallel if cores are available.
void parallelInvoke(const std::function<void()>& first, const std::function<void()>& second);

/// Limits the number of working threads in its scope (0 = number of cores).
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// Current number of working threads.
int threadCount();

}  // namespace softscope
