// eval/statistics/error_series.h: how an error changes over time: drift and jitter.
#pragma once

#include <vector>

namespace softscope {

/// Drift: the median slope of all pairs of samples (Theil 1950, Sen 1968), in units of y per unit
/// of x; a third of the samples may be wild. Samples that are not finite take no part; NaN where
/// fewer than two different x remain. Of more than 2000 samples every k-th is taken, so that 2000
/// or fewer remain.
double theilSenSlope(const std::vector<double>& x, const std::vector<double>& y);

/// Jitter: y[i-1] - 2 y[i] + y[i+1], one a sample; NaN at both ends, beside values that are not
/// finite, and where the two neighbours in x are not equally far (within 1 %).
std::vector<double> secondDifferences(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace softscope
