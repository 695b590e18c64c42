#include "pipeline/frame_ahead.h"

namespace softscope {

FrameView FrameAhead::measureNow(std::future<FrameViews> begun, const Frame& frame,
                                 StageClock* clock) {
  MeasuredFrame measured = depth_->measure(begun.valid() ? begun.get() : depth_->viewsOf(frame));
  clock->lap("depth");
  FrameView view = viewFrame(std::move(measured), depth_->rig(), options_);
  clock->lap("mask");
  return view;
}

/// What was begun for this frame; of another one it is of no use.
std::future<FrameViews> FrameAhead::takeViews(const Frame& frame) {
  if (views_.valid() && aligned_ != &frame) {
    views_.wait();
    views_ = {};
  }
  return std::move(views_);
}

void FrameAhead::prepare(const Frame& next, const Frame* after) {
  if (result_.valid()) result_.wait();
  prepared_ = &next;
  result_ = std::async(std::launch::async, [this, &next, begun = takeViews(next)]() mutable {
    StageClock unused;
    return measureNow(std::move(begun), next, &unused);
  });
  if (after == nullptr) return;
  aligned_ = after;
  views_ = std::async(std::launch::async, [this, after] { return depth_->viewsOf(*after); });
}

FrameView FrameAhead::measure(const Frame& frame, StageClock* clock) {
  if (!result_.valid()) return measureNow(takeViews(frame), frame, clock);
  if (prepared_ != &frame) {  // what was prepared is of no use
    result_.wait();
    result_ = {};
    return measureNow(takeViews(frame), frame, clock);
  }
  FrameView view = result_.get();
  clock->lap("depth");
  return view;
}

}  // namespace softscope
