#include "apps/work_progress.h"

#include <iostream>
#include <utility>

namespace softscope {

WorkProgress::WorkProgress(std::string what, ProgressBar::Style style,
                           const InterruptGuard& interrupt)
    : what_(std::move(what)), style_(style), interrupt_(interrupt) {}

Progress WorkProgress::callback() {
  return [this](int done, int total) { return tell(done, total); };
}

bool WorkProgress::tell(int done, int total) {
  if (!bar_) bar_.emplace(what_, total, style_, std::cerr);
  for (; told_ < done; ++told_) bar_->advance();
  return !interrupted();
}

}  // namespace softscope
