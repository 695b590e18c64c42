// src/pipeline/frame/match_stage.h: matched points from the model and a live image.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>

#include "core/point_model.h"
#include "core/rectified_rig.h"
#include "pipeline/frame/model_matches.h"
#include "pipeline/options/reconstruction_options.h"
#include "stereo/matching/stage_clock.h"

namespace softscope {

/// Stages 2 and 3 of a frame: model view, matches, lifted matches. May
/// run on another device. All implementations give the same bytes.
class MatchStage {
 public:
  virtual ~MatchStage() = default;
  /// Renders the model from `viewed_from` and matches it with `live`, the image of the
  /// measured frame. `seen_gray`: image recorded from there, matched instead of the
  /// rendering; empty: the rendering. Laps `view` and `match`, or `match` alone for both.
  virtual ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                             const GrayImage& seen_gray, const MatchPicture& live,
                             const MeasuredFrame& frame, StageClock* clock) = 0;
  /// Begins match() without a recorded image. False: it does not run in parallel to other stages.
  /// All arguments may change afterwards.
  virtual bool begin(const PointModel& /*model*/, const Eigen::Isometry3d& /*viewed_from*/,
                     const MatchPicture& /*live*/, const MeasuredFrame& /*frame*/) {
    return false;
  }
  /// Result of what begin() began.
  virtual ModelMatches take(StageClock* /*clock*/) { return {}; }
};

using MatchStageFactory =
    std::function<std::unique_ptr<MatchStage>(const ReconstructionOptions&, const RectifiedRig&)>;

/// On the CPU. Throws OptionError.
std::unique_ptr<MatchStage> makeCpuMatchStage(const ReconstructionOptions& options,
                                              const RectifiedRig& rig);

}  // namespace softscope
