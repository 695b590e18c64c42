#include "pipeline/frame/frame_ahead.h"

#include <chrono>

#include "core/background_work.h"

namespace softscope {

FrameAhead::Aligned FrameAhead::align(const Frame& frame) const {
  Aligned aligned{depth_->viewsOf(frame), {}};
  aligned.pictures = framePictures(aligned.views, options_);
  return aligned;
}

FrameView FrameAhead::measureNow(std::future<Aligned> begun, const Frame& frame,
                                 StageClock* clock) {
  Aligned aligned = begun.valid() ? begun.get() : align(frame);
  const FramePictures& pictures = aligned.pictures;
  survey_->show(aligned.views.left(), pictures.not_tissue, pictures.live.gray,
                pictures.live.ignore);
  MeasuredFrame measured = depth_->measure(std::move(aligned.views));
  clock->lap("depth");
  FrameView view = viewFrame(std::move(measured), std::move(aligned.pictures), depth_->rig(),
                             options_, survey_.get());
  view.serial = ++measured_;
  clock->lap("mask");
  return view;
}

/// What was begun for this frame; of another one it is of no use.
std::future<FrameAhead::Aligned> FrameAhead::takeViews(const Frame& frame) {
  if (views_.valid() && aligned_.get() != &frame) {
    views_.wait();
    views_ = {};
  }
  return std::move(views_);
}

void FrameAhead::addRelief(FrameView* view) {
  const RectifiedRig& rig = depth_->rig();
  view->relief_px =
      survey_->reliefOf(observationOf(*view, rig.left), rig.left.fx_px * rig.baseline_mm);
}

void FrameAhead::prepare(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> after,
                         bool with_relief) {
  if (result_.valid()) result_.wait();
  std::future<Aligned> begun = takeViews(*next);
  prepared_ = std::move(next);
  result_ = std::async(std::launch::async,
                       [this, with_relief, frame = prepared_, begun = std::move(begun)]() mutable {
                         StageClock unused;
                         auto view = std::make_shared<FrameView>();
                         runInBackground([&] {
                           *view = measureNow(std::move(begun), *frame, &unused);
                           if (with_relief) addRelief(view.get());
                         });
                         return view;
                       });
  if (after == nullptr) return;
  aligned_ = std::move(after);
  views_ = std::async(std::launch::async, [this, frame = aligned_] {
    Aligned aligned;
    runInBackground([&] { aligned = align(*frame); });
    return aligned;
  });
}

FrameView FrameAhead::measure(const Frame& frame, StageClock* clock) {
  FrameView view = take(frame, clock);
  survey_->use(view.measured.depth);
  return view;
}

FrameView FrameAhead::take(const Frame& frame, StageClock* clock) {
  if (!result_.valid()) return measureNow(takeViews(frame), frame, clock);
  if (prepared_.get() != &frame) {  // what was prepared is of no use
    result_.wait();
    result_ = {};
    return measureNow(takeViews(frame), frame, clock);
  }
  FrameView view = std::move(*std::exchange(result_, {}).get());
  clock->lap("depth");
  return view;
}

const FrameView* FrameAhead::next() const {
  if (!result_.valid() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return nullptr;
  try {
    return result_.get().get();
  } catch (...) {
    return nullptr;  // measure() throws it
  }
}

}  // namespace softscope
