// eval/statistics/error_series.h: drift and jitter of an error over time.
#pragma once

#include <vector>

namespace softscope {

/// Drift: median slope of all pairs of samples (Theil 1950, Sen 1968), in
/// units of y per unit of x; robust to a third of outliers. Without
/// samples that are not finite; NaN for fewer than two different x. Of
/// more than 2000 samples every k-th is used, so that at most 2000 remain.
double theilSenSlope(const std::vector<double>& x, const std::vector<double>& y);

/// Jitter: y[i-1] - 2 y[i] + y[i+1], one per sample; NaN at both ends, next to values that
/// are not finite, and if the distances in x to both neighbours differ (by more than 1 %).
std::vector<double> secondDifferences(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace softscope
