// src/pipeline/frame/match_ahead.h: matches of the next frame, computed in parallel to the end of
// the current one.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "pipeline/frame/frame_view.h"
#include "pipeline/frame/match_stage.h"

namespace softscope {

/// MatchStage with at most one match begun ahead. Same results.
class MatchAhead {
 public:
  explicit MatchAhead(std::unique_ptr<MatchStage> stage) : stage_(std::move(stage)) {}

  /// Begins, if the stage can, match() of the updated model with that frame. If a device fails,
  /// match() meets the failure.
  void begin(const PointModel& model, const Eigen::Isometry3d& viewed_from, const FrameView& next);
  /// The model has changed since.
  void drop() { begun_.reset(); }
  /// As MatchStage::match(); takes what was begun, if that is the same.
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const FrameView& frame, StageClock* clock);

 private:
  struct Begun {
    int frame;  // its serial number
    Eigen::Isometry3d viewed_from;
  };
  std::unique_ptr<MatchStage> stage_;
  std::optional<Begun> begun_;
};

}  // namespace softscope
