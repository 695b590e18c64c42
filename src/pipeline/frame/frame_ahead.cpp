#include "pipeline/frame/frame_ahead.h"

#include <algorithm>

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

void FrameAhead::addRelief(FrameView* view) {
  const RectifiedRig& rig = depth_->rig();
  view->relief_px =
      survey_->reliefOf(observationOf(*view, rig.left), rig.left.fx_px * rig.baseline_mm);
}

void FrameAhead::beginAligning(const std::shared_ptr<const Frame>& frame) {
  Coming coming;
  coming.frame = frame;
  coming.views = std::async(std::launch::async, [this, frame] {
    Aligned aligned;
    runInBackground([&] { aligned = align(*frame); });
    return aligned;
  });
  coming_.push_back(std::move(coming));
}

/// After the frame before it.
void FrameAhead::beginMeasuring(std::size_t index, bool with_relief) {
  Coming& coming = coming_[index];
  coming.measured = std::make_shared<Measured>();
  auto work = [this, with_relief, frame = coming.frame, measured = coming.measured,
               views = std::move(coming.views),
               before = index > 0 ? coming_[index - 1].done : decltype(coming.done)()]() mutable {
    if (before.valid()) before.wait();
    StageClock unused;
    runInBackground([&] {
      measured->view = measureNow(std::move(views), *frame, &unused);
      measured->is_found = true;
      if (with_relief) addRelief(&measured->view);
    });
  };
  coming.done = std::async(std::launch::async, std::move(work)).share();
}

/// Waits for their threads.
void FrameAhead::dropFrom(std::size_t first) {
  while (coming_.size() > first) coming_.pop_back();
}

void FrameAhead::prepare(const UpcomingFrames& upcoming, bool with_relief) {
  const auto isSame = [](const Coming& coming, const auto& frame) { return coming.frame == frame; };
  const auto begun =
      std::mismatch(coming_.begin(), coming_.end(), upcoming.begin(), upcoming.end(), isSame).first;
  dropFrom(static_cast<std::size_t>(begun - coming_.begin()));
  const auto atMost = [&](int count) { return std::min(upcoming.size(), std::size_t(count)); };
  while (coming_.size() < atMost(ahead_.aligned)) beginAligning(upcoming[coming_.size()]);
  for (std::size_t i = 0; i < atMost(ahead_.measured); ++i)
    if (coming_[i].measured == nullptr) beginMeasuring(i, with_relief);
}

FrameView FrameAhead::measure(const Frame& frame, StageClock* clock) {
  FrameView view = take(frame, clock);
  survey_->use(view.measured.depth);
  return view;
}

FrameView FrameAhead::take(const Frame& frame, StageClock* clock) {
  if (!coming_.empty() && coming_.front().frame.get() != &frame) dropFrom(0);  // of no use
  if (coming_.empty()) return measureNow({}, frame, clock);
  Coming coming = std::move(coming_.front());
  coming_.pop_front();
  if (coming.measured == nullptr) return measureNow(std::move(coming.views), frame, clock);
  coming.done.get();
  clock->lap("depth");
  return std::move(coming.measured->view);
}

const FrameView* FrameAhead::next() const {
  const bool is_found =
      !coming_.empty() && coming_.front().measured && coming_.front().measured->is_found;
  return is_found ? &coming_.front().measured->view : nullptr;
}

}  // namespace softscope
