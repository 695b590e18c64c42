// apps/work_progress.h: progress bar and Ctrl-C for work of the toolkit.
#pragma once

#include <optional>
#include <string>

#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "toolkit/progress.h"

namespace softscope {

/// The line of the bar ends with the work, finished or stopped.
class WorkProgress {
 public:
  WorkProgress(std::string what, ProgressBar::Style style, const InterruptGuard& interrupt);

  /// Shows the progress. Returns false after a stop
  /// request of the user. Must outlive the callback.
  Progress callback();
  bool interrupted() const { return interrupt_.requested(); }

 private:
  bool update(int done, int total);

  std::string what_;
  ProgressBar::Style style_;
  const InterruptGuard& interrupt_;
  std::optional<ProgressBar> bar_;
  int shown_ = 0;
  bool ended_ = false;
};

/// Warnings, notes and failures go to the log.
WorkListener logListener();
/// With the bar and Ctrl-C.
WorkListener listenerOf(WorkProgress& progress);

}  // namespace softscope
