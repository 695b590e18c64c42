#include "apps/threshold_exit.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "apps/exit_codes.h"

namespace softscope {

int exitCodeOf(const std::vector<ThresholdOutcome>& outcomes) {
  int code = kDone;
  for (const ThresholdOutcome& outcome : outcomes) {
    if (!outcome.failed) continue;
    code = kThresholdFailed;
    spdlog::error("failed: {} is {}, and --fail-if says {}", outcome.path,
                  std::isnan(outcome.value) ? "not measured" : fixed(outcome.value, 4),
                  outcome.threshold.text());
  }
  return code;
}

}  // namespace softscope
