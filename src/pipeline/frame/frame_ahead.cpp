#include "pipeline/frame/frame_ahead.h"

#include <algorithm>
#include <chrono>

#include "core/background_work.h"
#include "core/error.h"
#include "stereo/depth/relief_error.h"

namespace softscope {

FrameAhead::Aligned FrameAhead::align(const Frame& frame) const {
  Aligned aligned{depth_->viewsOf(frame), {}};
  aligned.pictures = framePictures(aligned.views, options_);
  return aligned;
}

FrameAhead::Measured FrameAhead::measureNow(std::future<Aligned> begun, const Frame& frame,
                                            StageClock* clock) {
  Aligned aligned = begun.valid() ? begun.get() : align(frame);
  const FramePictures& pictures = aligned.pictures;
  survey_->show(aligned.views.left(), pictures.not_tissue, pictures.live.gray,
                pictures.live.ignore);
  Measured found;
  MeasuredFrame measured = depth_->measure(std::move(aligned.views), &found.normals);
  clock->lap("depth");
  found.view = viewFrame(std::move(measured), std::move(aligned.pictures), depth_->rig(), options_,
                         survey_.get());
  found.view.serial = ++measured_;
  clock->lap("mask");
  return found;
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
void FrameAhead::beginMeasuring(std::size_t index) {
  Coming& coming = coming_[index];
  auto work = [this, frame = coming.frame, views = std::move(coming.views),
               before = index > 0 ? coming_[index - 1].measured
                                  : decltype(coming.measured)()]() mutable {
    if (before.valid()) before.wait();
    StageClock unused;
    auto found = std::make_shared<Measured>();
    runInBackground([&] { *found = measureNow(std::move(views), *frame, &unused); });
    return found;
  };
  coming.measured = std::async(std::launch::async, std::move(work)).share();
}

/// Waits for their threads.
void FrameAhead::dropFrom(std::size_t first) {
  while (coming_.size() > first) coming_.pop_back();
}

void FrameAhead::prepare(const UpcomingFrames& upcoming) {
  const auto isSame = [](const Coming& coming, const auto& frame) { return coming.frame == frame; };
  const auto begun =
      std::mismatch(coming_.begin(), coming_.end(), upcoming.begin(), upcoming.end(), isSame).first;
  dropFrom(static_cast<std::size_t>(begun - coming_.begin()));
  const auto atMost = [&](int count) { return std::min(upcoming.size(), std::size_t(count)); };
  while (coming_.size() < atMost(ahead_.aligned)) beginAligning(upcoming[coming_.size()]);
  for (std::size_t i = 0; i < atMost(ahead_.measured); ++i)
    if (!coming_[i].measured.valid()) beginMeasuring(i);
}

FrameView FrameAhead::measure(const Frame& frame, StageClock* clock) {
  Measured found = take(frame, clock);
  normals_ = std::move(found.normals);
  survey_->use(found.view.measured.depth);
  return std::move(found.view);
}

FrameAhead::Measured FrameAhead::take(const Frame& frame, StageClock* clock) {
  if (!coming_.empty() && coming_.front().frame.get() != &frame) dropFrom(0);  // of no use
  if (coming_.empty()) return measureNow({}, frame, clock);
  Coming coming = std::move(coming_.front());
  coming_.pop_front();
  if (!coming.measured.valid()) return measureNow(std::move(coming.views), frame, clock);
  Measured found = std::move(*coming.measured.get());
  clock->lap("depth");
  return found;
}

const FrameView* FrameAhead::next() const {
  if (coming_.empty()) return nullptr;
  const auto& measured = coming_.front().measured;
  if (!measured.valid() || measured.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return nullptr;
  try {
    return &measured.get()->view;
  } catch (...) {
    return nullptr;  // measure() throws it
  }
}

void FrameAhead::complete(FrameView* view) {
  if (normals_.valid()) view->measured.normals = normals_.get();
}

Raster<float> FrameAhead::reliefOf(const FrameView& view) const {
  const RectifiedRig& rig = depth_->rig();
  const DepthMap& depth = view.measured.depth;
  if (depth.sigma_mm.empty()) return {};
  Raster<float> relief_px;
  try {
    relief_px = survey_->reliefOf(depth, rig.left.fx_px * rig.baseline_mm);
  } catch (const BackendError&) {
    // The next stage that needs the device says so.
  }
  return relief_px.empty() ? reliefErrorPx(depth.depth_mm, rig) : relief_px;
}

}  // namespace softscope
