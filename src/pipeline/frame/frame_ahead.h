// src/pipeline/frame/frame_ahead.h: stage 1 of the next frames, computed during the current one.
#pragma once

#include <atomic>
#include <deque>
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

/// Of the frames that come next, how many are worked on.
struct FramesAhead {
  int measured = 1;  // one at a time, in order
  int aligned = 2;   // their views, beside each other; not fewer
};

/// FrameDepth and viewFrame() of the next frames, each on threads of its own: the views of some are
/// aligned while one before them is matched. Same results.
class FrameAhead {
 public:
  /// Every frame lies on the device of its survey when measure() returns.
  FrameAhead(std::unique_ptr<FrameDepth> depth, const ReconstructionOptions& options,
             const FrameSurveyFactory& makeSurvey, const FramesAhead& ahead)
      : depth_(std::move(depth)),
        options_(options),
        survey_(makeSurvey(depth_->rig())),
        ahead_(ahead) {}

  const FrameDepth& depth() const { return *depth_; }

  /// Begins those that are not begun yet. `with_relief`: also their relief, where the survey finds
  /// it.
  void prepare(const UpcomingFrames& upcoming, bool with_relief);
  /// What was begun, if it is of this frame; whatever went wrong with it is thrown here. Laps
  /// `depth` and `mask`, or, where it was begun, the wait as `depth`.
  FrameView measure(const Frame& frame, StageClock* clock);
  /// What measure() will return for the next frame, but for its relief, where the rest is found by
  /// now; valid until then; else null.
  const FrameView* next() const;

 private:
  /// Everything that is found before the frame is measured.
  struct Aligned {
    FrameViews views;
    FramePictures pictures;
  };
  /// Being measured, on its thread.
  struct Measured {
    FrameView view;
    std::atomic<bool> is_found{false};  // but for the relief
  };
  struct Coming {
    std::shared_ptr<const Frame> frame;
    std::future<Aligned> views;  // until they are measured
    std::shared_ptr<Measured> measured;
    std::shared_future<void> done;
  };

  Aligned align(const Frame& frame) const;
  FrameView measureNow(std::future<Aligned> begun, const Frame& frame, StageClock* clock);
  void addRelief(FrameView* view);
  void beginAligning(const std::shared_ptr<const Frame>& frame);
  void beginMeasuring(std::size_t index, bool with_relief);
  FrameView take(const Frame& frame, StageClock* clock);
  void dropFrom(std::size_t first);

  std::unique_ptr<FrameDepth> depth_;
  ReconstructionOptions options_;
  std::unique_ptr<FrameSurvey> survey_;
  FramesAhead ahead_;
  int measured_ = 0;           // so far; one frame is measured at a time
  std::deque<Coming> coming_;  // ends before all that its threads use
};

}  // namespace softscope
