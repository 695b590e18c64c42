#include "apps/work_progress.h"

#include <spdlog/spdlog.h>

#include <iostream>
#include <utility>

namespace softscope {

WorkProgress::WorkProgress(std::string what, ProgressBar::Style style,
                           const InterruptGuard& interrupt)
    : what_(std::move(what)), style_(style), interrupt_(interrupt) {}

Progress WorkProgress::callback() {
  return [this](int done, int total) { return update(done, total); };
}

bool WorkProgress::update(int done, int total) {
  if (!bar_ && !ended_) bar_.emplace(what_, total, style_, std::cerr);
  for (; bar_ && shown_ < done; ++shown_) bar_->advance();
  ended_ = interrupted() || (done >= total && total > 0);
  if (ended_) bar_.reset();
  return !interrupted();
}

WorkListener logListener() {
  return {{},
          [](const std::string& text) { spdlog::warn("{}", text); },
          [](const std::string& text) { spdlog::info("{}", text); },
          [](const std::string& text) { spdlog::error("{}", text); }};
}

WorkListener listenerOf(WorkProgress& progress) {
  WorkListener listener = logListener();
  listener.progress = progress.callback();
  return listener;
}

}  // namespace softscope
