// toolkit/run/write_behind.h: files written on a thread of their own.
#pragma once

#include <deque>
#include <functional>
#include <future>

namespace softscope {

/// Works in order on another thread, so that a loop does not wait for the disk; with a single
/// thread (core/parallel.h), at once. The destructor waits for all work.
class WriteBehind {
 public:
  /// Works that may wait or be in progress, so that their memory is limited.
  static constexpr std::size_t kMostPending = 3;

  /// Returns once not more than that is pending. Throws the error of earlier work, after which
  /// nothing more is done: a checkpoint never follows a file that could not be written.
  void add(std::function<void()> work);
  /// Waits for all work. Throws as add() does.
  void finish();

 private:
  std::deque<std::shared_future<void>> pending_;  // and the last, once it has ended
};

}  // namespace softscope
