// apps/threshold_exit.h: exit code of a command with --fail-if.
#pragma once

#include <vector>

#include "toolkit/evaluation/thresholds.h"

namespace softscope {

/// kThresholdFailed if a threshold failed (each is printed to stderr); else kDone.
int exitCodeOf(const std::vector<ThresholdOutcome>& outcomes);

}  // namespace softscope
