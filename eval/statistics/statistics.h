// eval/statistics/statistics.h: summary statistics of a list of values.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace softscope {

/// In the unit of the values; NaN without values. Definitions: docs/evaluation.md.
struct Statistics {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;      // values without NaNs
  std::size_t nan_count = 0;  // excluded from all other members
  double mean = kNone;
  double sd = kNone;    // about the mean, divisor count (not count - 1)
  double rmse = kNone;  // root mean square, about zero
  double min = kNone;
  double median = kNone;
  double p95 = kNone;
  double max = kNone;
};

/// The values that are not NaN, in their order.
std::vector<double> withoutNaN(const std::vector<double>& values);

Statistics statistics(const std::vector<double>& values);

/// One value per entry of `percents` (0 to 100): without NaNs, linear
/// interpolation between ranks as numpy.percentile. NaN without
/// values. Throws OptionError for a percent outside of 0 to 100.
std::vector<double> percentiles(const std::vector<double>& values,
                                const std::vector<double>& percents);

/// Percentage of the values (without NaNs) above the threshold; NaN without values.
double percentAbove(const std::vector<double>& values, double threshold);

}  // namespace softscope
