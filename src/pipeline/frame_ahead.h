// src/pipeline/frame_ahead.h: stage 1, of the next frame too while this one is worked on.
#pragma once

#include <future>
#include <memory>
#include <utility>

#include "pipeline/frame_depth.h"
#include "pipeline/frame_view.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {

/// FrameDepth and viewFrame() with at most one frame under way on a thread of its own. Same
/// results.
class FrameAhead {
 public:
  FrameAhead(std::unique_ptr<FrameDepth> depth, const ReconstructionOptions& options)
      : depth_(std::move(depth)), options_(options) {}

  const FrameDepth& depth() const { return *depth_; }

  /// Begins. `next` must live and stay as it is until measure() has been called again.
  void prepare(const Frame& next);
  /// What was begun, if that is this frame; whatever went wrong with it is thrown here. Laps
  /// `depth` and `mask`, or, where it was begun, the wait as `depth`.
  FrameView measure(const Frame& frame, StageClock* clock);

 private:
  FrameView measureNow(const Frame& frame, StageClock* clock);

  std::unique_ptr<FrameDepth> depth_;
  ReconstructionOptions options_;
  const Frame* prepared_ = nullptr;
  std::future<FrameView> result_;  // ends before depth_ does
};

}  // namespace softscope
