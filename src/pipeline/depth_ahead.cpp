#include "pipeline/depth_ahead.h"

namespace softscope {

void DepthAhead::prepare(const Frame& next) {
  if (result_.valid()) result_.wait();
  prepared_ = &next;
  result_ = std::async(std::launch::async, [this, &next] { return depth_->measure(next); });
}

MeasuredFrame DepthAhead::measure(const Frame& frame) {
  if (!result_.valid()) return depth_->measure(frame);
  if (prepared_ == &frame) return result_.get();
  result_.wait();  // another frame came: what was prepared is of no use
  result_ = {};
  return depth_->measure(frame);
}

}  // namespace softscope
