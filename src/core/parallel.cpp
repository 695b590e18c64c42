#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/background_work.h"

namespace softscope {

void parallelRanges(int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  if (count <= grain || threadCount() == 1) return body(0, count);
  tbb::parallel_for(tbb::blocked_range<int>(0, count, static_cast<std::size_t>(grain)),
                    [&](const tbb::blocked_range<int>& r) { body(r.begin(), r.end()); });
}

std::vector<int> parallelFind(
    int count, int grain,
    const std::function<void(int begin, int end, std::vector<int>* found)>& body) {
  std::vector<std::vector<int>> parts(static_cast<std::size_t>((count + grain - 1) / grain));
  parallelRanges(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      body(i * grain, std::min((i + 1) * grain, count), &parts[static_cast<std::size_t>(i)]);
  });
  std::vector<int> found;
  for (const std::vector<int>& part : parts) found.insert(found.end(), part.begin(), part.end());
  return found;
}

void parallelInvoke(const std::function<void()>& first, const std::function<void()>& second) {
  tbb::parallel_invoke(first, second);
}

void runInBackground(const std::function<void()>& work) {
  tbb::task_arena arena(tbb::task_arena::automatic, 1, tbb::task_arena::priority::low);
  arena.execute(work);
}

struct ThreadLimit::Control {
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  control_.reset(new Control{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(threads))});
}
ThreadLimit::~ThreadLimit() = default;

int threadCount() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace softscope
