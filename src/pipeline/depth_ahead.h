// src/pipeline/depth_ahead.h: stage 1, of the next frame too while this one is worked on.
#pragma once

#include <future>
#include <memory>
#include <utility>

#include "pipeline/frame_depth.h"

namespace softscope {

/// FrameDepth with at most one frame under way on a thread of its own. Same results.
class DepthAhead {
 public:
  explicit DepthAhead(std::unique_ptr<FrameDepth> depth) : depth_(std::move(depth)) {}

  const FrameDepth& depth() const { return *depth_; }

  /// Begins. `next` must live and stay as it is until measure() has been called again.
  void prepare(const Frame& next);
  /// What was begun, if that is this frame; whatever went wrong with it is thrown here.
  MeasuredFrame measure(const Frame& frame);

 private:
  std::unique_ptr<FrameDepth> depth_;
  const Frame* prepared_ = nullptr;
  std::future<MeasuredFrame> result_;  // ends before depth_ does
};

}  // namespace softscope
