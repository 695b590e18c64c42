// src/core/parallel.h: loops over all cores with results that do not depend on their number.
#pragma once

#include <functional>
#include <memory>

namespace softscope {

/// Calls body(begin, end) over disjoint ranges that cover [0, count). Deterministic as long as
/// body writes only what belongs to its own range. `grain` is the smallest range worth a task.
void parallelRanges(int count, int grain, const std::function<void(int begin, int end)>& body);

/// A grain for loops over a point model.
inline constexpr int kPointsATask = 4096;

/// Calls body(v) for every row v of [0, rows).
template <class Body>
void parallelRows(int rows, const Body& body) {
  parallelRanges(rows, 8, [&](int begin, int end) {
    for (int v = begin; v < end; ++v) body(v);
  });
}

/// Runs both, at the same time where there are cores for it.
void parallelInvoke(const std::function<void()>& first, const std::function<void()>& second);

/// In its scope, at most `threads` threads work (0 = as many as there are cores).
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

/// How many threads would work now.
int threadCount();

}  // namespace softscope
