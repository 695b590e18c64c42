// src/pipeline/frame/frame_ahead.h: stage 1 of the next two frames, computed during the current
// one.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "fusion/frame_survey.h"
#include "pipeline/frame/frame_depth.h"
#include "pipeline/frame/frame_view.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {

using FrameSurveyFactory = std::function<std::unique_ptr<FrameSurvey>(const RectifiedRig&)>;

/// FrameDepth and viewFrame() with at most two frames under way, each on a thread of its own: the
/// views of one are aligned while the one before it is matched. Same results.
class FrameAhead {
 public:
  /// Every frame lies on the device of its survey when measure() returns.
  FrameAhead(std::unique_ptr<FrameDepth> depth, const ReconstructionOptions& options,
             const FrameSurveyFactory& makeSurvey)
      : depth_(std::move(depth)), options_(options), survey_(makeSurvey(depth_->rig())) {}

  const FrameDepth& depth() const { return *depth_; }

  /// Begins, with `after` (the frame after it) too, where that isn't null. `with_relief`: also the
  /// next frame's relief, where its survey finds it.
  void prepare(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> after,
               bool with_relief);
  /// What was begun, if that is this frame; whatever went wrong with it is thrown here. Laps
  /// `depth` and `mask`, or, where it was begun, the wait as `depth`.
  FrameView measure(const Frame& frame, StageClock* clock);
  /// What measure() will return for the next frame, where that is measured by now, valid until
  /// then; else null.
  const FrameView* next() const;

 private:
  /// Everything that is found before the frame is measured.
  struct Aligned {
    FrameViews views;
    FramePictures pictures;
  };
  Aligned align(const Frame& frame) const;
  FrameView measureNow(std::future<Aligned> begun, const Frame& frame, StageClock* clock);
  void addRelief(FrameView* view);
  std::future<Aligned> takeViews(const Frame& frame);
  FrameView take(const Frame& frame, StageClock* clock);

  std::unique_ptr<FrameDepth> depth_;
  ReconstructionOptions options_;
  std::unique_ptr<FrameSurvey> survey_;
  int measured_ = 0;  // so far; one frame is measured at a time
  std::shared_ptr<const Frame> prepared_, aligned_;
  std::future<Aligned> views_;  // of aligned_; both end before the frames and depth_ do
  std::shared_future<std::shared_ptr<FrameView>> result_;  // of prepared_
};

}  // namespace softscope
