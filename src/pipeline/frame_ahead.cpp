#include "pipeline/frame_ahead.h"

namespace softscope {

FrameView FrameAhead::measureNow(const Frame& frame, StageClock* clock) {
  MeasuredFrame measured = depth_->measure(frame);
  clock->lap("depth");
  FrameView view = viewFrame(std::move(measured), depth_->rig(), options_);
  clock->lap("mask");
  return view;
}

void FrameAhead::prepare(const Frame& next) {
  if (result_.valid()) result_.wait();
  prepared_ = &next;
  result_ = std::async(std::launch::async, [this, &next] {
    StageClock unused;
    return measureNow(next, &unused);
  });
}

FrameView FrameAhead::measure(const Frame& frame, StageClock* clock) {
  if (!result_.valid()) return measureNow(frame, clock);
  if (prepared_ != &frame) {  // what was prepared is of no use
    result_.wait();
    result_ = {};
    return measureNow(frame, clock);
  }
  FrameView view = result_.get();
  clock->lap("depth");
  return view;
}

}  // namespace softscope
