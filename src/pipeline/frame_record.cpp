#include "pipeline/frame_record.h"

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
  }
  return "unreadable";
}

double FrameRecord::elapsed_ms() const {
  double sum = 0;
  for (const auto& stage : times) sum += stage.second;
  return sum;
}

}  // namespace softscope
