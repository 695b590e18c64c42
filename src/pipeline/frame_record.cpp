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
  const double most = map == 0 ? 1 : kUnknownPlace;
  // The minimum of an unknown number and another is the other.
  if (status == FrameStatus::kStarted)
    return map == 0 ? depth.precise_share : std::fmin(depth.precise_share, most);
  if (!std::isfinite(evidence.view.depth_share)) return kUnknown;
  return std::fmin(std::fmin(evidence.view.agreement(), depth.precise_share), most);
}

double FrameRecord::elapsed_ms() const {
  double sum = 0;
  for (const auto& stage : times) sum += stage.second;
  return sum;
}

}  // namespace softscope
