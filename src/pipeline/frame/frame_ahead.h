// src/pipeline/frame/frame_ahead.h: stage 1 of the next frames, computed during the current one.
#pragma once

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

  /// Begins those that are not begun yet.
  void prepare(const UpcomingFrames& upcoming);
  /// What was begun, if it is of this frame; whatever went wrong with it is thrown here. Laps
  /// `depth` and `mask`, or, where it was begun, the wait as `depth`. Without its normals.
  FrameView measure(const Frame& frame, StageClock* clock);
  /// Adds its normals to the frame that measure() returned last.
  void complete(FrameView* view);
  /// What measure() will return for the next frame, where that is measured by now, valid until
  /// then; else null.
  const FrameView* next() const;
  /// reliefErrorPx() of the frame that measure() returned last, on any thread, until it is called
  /// again; empty without sigmas.
  Raster<float> reliefOf(const FrameView& view) const;

 private:
  /// Everything that is found before the frame is measured.
  struct Aligned {
    FrameViews views;
    FramePictures pictures;
  };
  struct Measured {
    FrameView view;
    std::future<NormalMap> normals;  // its own, if they are on their way
  };
  struct Coming {
    std::shared_ptr<const Frame> frame;
    std::future<Aligned> views;                              // until they are measured
    std::shared_future<std::shared_ptr<Measured>> measured;  // once it is begun
  };

  Aligned align(const Frame& frame) const;
  Measured measureNow(std::future<Aligned> begun, const Frame& frame, StageClock* clock);
  void beginAligning(const std::shared_ptr<const Frame>& frame);
  void beginMeasuring(std::size_t index);
  Measured take(const Frame& frame, StageClock* clock);
  void dropFrom(std::size_t first);

  std::unique_ptr<FrameDepth> depth_;
  ReconstructionOptions options_;
  std::unique_ptr<FrameSurvey> survey_;
  FramesAhead ahead_;
  int measured_ = 0;                // so far; one frame is measured at a time
  std::future<NormalMap> normals_;  // of the frame at hand, if they are on their way
  std::deque<Coming> coming_;       // ends before all that its threads use
};

}  // namespace softscope
