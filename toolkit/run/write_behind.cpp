#include "toolkit/run/write_behind.h"

#include <utility>

#include "core/background_work.h"
#include "core/parallel.h"

namespace softscope {

void WriteBehind::add(std::function<void()> work) {
  if (threadCount() == 1) return work();
  std::shared_future<void> before;
  if (!pending_.empty()) before = pending_.back();
  // Its end frees what the work holds, and with `before` the work before it.
  auto next = [before, work = std::move(work)]() mutable {
    const auto earlier = std::move(before);
    const auto own = std::move(work);
    if (earlier.valid()) earlier.get();
    runInBackground(own);
  };
  pending_.push_back(std::async(std::launch::async, std::move(next)).share());
  while (pending_.size() > kMostPending) {
    pending_.front().get();
    pending_.pop_front();
  }
}

void WriteBehind::finish() {
  if (!pending_.empty()) pending_.back().get();
}

}  // namespace softscope
