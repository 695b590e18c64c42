// apps/threshold_exit.h: the exit code of a command with --fail-if.
#pragma once

#include <vector>

#include "toolkit/evaluation/thresholds.h"

namespace softscope {

/// kThresholdFailed where one failed, each of which is told on stderr; else kDone.
int exitCodeOf(const std::vector<ThresholdOutcome>& outcomes);

}  // namespace softscope
