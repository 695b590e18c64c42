#include "pipeline/frame/match_ahead.h"

#include "core/error.h"

namespace softscope {

void MatchAhead::begin(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                       const FrameView& next) {
  drop();
  try {
    if (stage_->begin(model, viewed_from, next.live, next.measured))
      begun_ = {next.serial, viewed_from};
  } catch (const BackendError&) {
    // The frame at hand is complete without it.
  }
}

ModelMatches MatchAhead::match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                               const GrayImage& seen_gray, const FrameView& frame,
                               StageClock* clock) {
  const std::optional<Begun> begun = std::exchange(begun_, std::nullopt);
  if (begun && begun->frame == frame.serial && seen_gray.empty() &&
      begun->viewed_from.matrix() == viewed_from.matrix())
    return stage_->take(clock);
  return stage_->match(model, viewed_from, seen_gray, frame.live, frame.measured, clock);
}

}  // namespace softscope
