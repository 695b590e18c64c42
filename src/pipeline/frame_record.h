// src/pipeline/frame_record.h: outcome of one frame: a row of frames.csv.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/reconstruction_backend.h"

namespace softscope {

enum class FrameStatus {
  kStarted,          // the model began with it
  kFused,            // the model learned from it
  kRecovered,        // so did it, after the model had been lost
  kSkippedDepth,     // too little depth; the model stays as it was
  kLost,             // no pose: the model was not found in it
  kSkippedResidual,  // located, but the model could not be bent to it
  kUnconfirmed,      // located and bent, but the model does not show what the frame shows
  kUnreadable,       // its files are missing or broken
  kUnpaired,         // the other view has no image of its moment
};

const char* toString(FrameStatus status);
/// None where no status has this name.
std::optional<FrameStatus> frameStatusNamed(std::string_view name);

struct FrameRecord {
  int frame = 0;
  double time_s = kUnknown;
  FrameStatus status = FrameStatus::kUnreadable;
  std::string reason;  // why it was not fused; empty where it was
  /// The last known pose where this frame has none of its own.
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  DepthSummary depth;
  MatchSummary matches;
  PoseSummary pose;
  WarpSummary warp;
  EvidenceSummary evidence;
  FusionSummary fusion;
  int points = 0;
  std::vector<TrackedPosition> tracked;
  StageTimes times;

  bool fused() const {
    return status == FrameStatus::kStarted || status == FrameStatus::kFused ||
           status == FrameStatus::kRecovered;
  }
  double elapsed_ms() const;
};

}  // namespace softscope
