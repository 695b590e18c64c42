#include "pipeline/frame_record.h"

#include <cmath>

namespace softscope {

const char* toString(FrameStatus status) {
  switch (status) {
    case FrameStatus::kStarted:
      return "started";
    case FrameStatus::kFused:
      return "fused";
    case FrameStatus::kRecovered:
      return "recovered";
    case FrameStatus::kSkippedDepth:
      return "skipped_depth";
    case FrameStatus::kLost:
      return "lost";
    case FrameStatus::kSkippedResidual:
      return "skipped_residual";
    case FrameStatus::kUnconfirmed:
      return "unconfirmed";
    case FrameStatus::kUnreadable:
      return "unreadable";
    case FrameStatus::kUnpaired:
      return "unpaired";
  }
  return "unreadable";
}

std::optional<FrameStatus> frameStatusNamed(std::string_view name) {
  for (const FrameStatus status :
       {FrameStatus::kStarted, FrameStatus::kFused, FrameStatus::kRecovered,
        FrameStatus::kSkippedDepth, FrameStatus::kLost, FrameStatus::kSkippedResidual,
        FrameStatus::kUnconfirmed, FrameStatus::kUnreadable, FrameStatus::kUnpaired})
    if (name == toString(status)) return status;
  return std::nullopt;
}

double FrameRecord::confidence() const {
  constexpr double kUnknownPlace = 0.5;
  const bool is_first = status == FrameStatus::kStarted;
  if (!is_first && !std::isfinite(evidence.view.depth_share)) return kUnknown;
  // The minimum of an unknown number and another is the other.
  const double precise = std::fmin(depth.precise_share, precise_tracks_share);
  const double certain = is_first ? precise : std::fmin(evidence.view.agreement(), precise);
  const bool is_placed = map == 0 && (is_first || pose.found);
  return is_placed ? certain : std::fmin(certain, kUnknownPlace);
}

double FrameRecord::elapsed_ms() const {
  double sum = 0;
  for (const auto& stage : times) sum += stage.second;
  return sum;
}

}  // namespace softscope
