// src/pipeline/frame_record.h: outcome of one frame: a row of frames.csv.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/reconstruction_backend.h"

namespace softscope {

enum class FrameStatus {
  kStarted,          // the model was initialised with it
  kFused,            // the model was updated with it
  kRecovered,        // the same, after a loss of the model
  kSkippedDepth,     // too little depth; the model is unchanged
  kLost,             // no pose: the model was not found in the frame
  kSkippedResidual,  // located, but the residual of the warp is too large
  kUnconfirmed,      // located and warped, but the model does not agree with the frame
  kUnreadable,       // its files are missing or damaged
  kUnpaired,         // no image of the other view at the same time, or one stands still
};

const char* toString(FrameStatus status);
/// Empty for an unknown name.
std::optional<FrameStatus> frameStatusNamed(std::string_view name);

/// Two maps recognised as one: what was in the world of `from` is in that of `into` now.
struct MapJoin {
  int from = 0, into = 0;
  Eigen::Isometry3d into_from = Eigen::Isometry3d::Identity();
};

struct FrameRecord {
  int frame = 0;
  double time_s = kUnknown;
  FrameStatus status = FrameStatus::kUnreadable;
  std::string reason;  // why it was not fused; empty if it was
  /// In whose world the pose is: 0 for the first model, another number for one begun elsewhere.
  int map = 0;
  std::optional<MapJoin> join;  // of this frame
  /// The last known pose for a frame without a pose.
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  DepthSummary depth;
  MatchSummary matches;
  PoseSummary pose;
  WarpSummary warp;
  EvidenceSummary evidence;
  FusionSummary fusion;
  int points = 0;
  std::vector<TrackedPosition> tracked;
  double precise_tracks_share = kUnknown;  // preciseShare() of them
  StageTimes times;

  bool fused() const {
    return status == FrameStatus::kStarted || status == FrameStatus::kFused ||
           status == FrameStatus::kRecovered;
  }
  /// Of pose, warp, depth and tracked points, 0 to 1: docs/fusion.md (F27). NaN if neither the
  /// first fused frame, of depth with sigmas, nor compared with the model. At most one half in
  /// another map than the first, whose pose relative to the first one is not known, and at the last
  /// pose, without one of its own.
  double confidence() const;
  double elapsed_ms() const;
};

}  // namespace softscope
