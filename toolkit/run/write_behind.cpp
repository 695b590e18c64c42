#include "toolkit/run/write_behind.h"

#include <exception>
#include <utility>

#include "core/background_work.h"
#include "core/parallel.h"

namespace softscope {

void WriteBehind::add(std::function<void()> work) {
  if (threadCount() == 1) return work();
  std::shared_future<void> before;
  if (!pending_.empty()) before = pending_.back();
  pending_.push_back(std::async(std::launch::async, [before, work = std::move(work)] {
                       if (before.valid()) before.wait();
                       runInBackground(work);
                     }).share());
  waitUntil(kMostPending);
}

void WriteBehind::finish() { waitUntil(0); }

void WriteBehind::waitUntil(std::size_t left) {
  std::exception_ptr failure;
  for (; pending_.size() > left; pending_.pop_front()) {
    try {
      pending_.front().get();
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace softscope
