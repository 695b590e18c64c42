// eval/statistics/statistics.h: many numbers in a few.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace softscope {

/// In the unit of the values; NaN where there were none. Definitions: docs/evaluation.md.
struct Statistics {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;      // values that are numbers
  std::size_t nan_count = 0;  // left out everywhere else
  double mean = kNone;
  double sd = kNone;    // about the mean, over count (not count - 1)
  double rmse = kNone;  // root of the mean square: about zero
  double min = kNone;
  double median = kNone;
  double p95 = kNone;
  double max = kNone;
};

/// The values that are not NaN, in their order.
std::vector<double> withoutNaN(const std::vector<double>& values);

Statistics statistics(const std::vector<double>& values);

/// One value for each of `percents` (0 to 100): NaNs left out, linear between the two neighbours
/// in rank, as numpy.percentile does. NaN where there are no values.
/// Throws OptionError for a percent outside 0 to 100.
std::vector<double> percentiles(const std::vector<double>& values,
                                const std::vector<double>& percents);

/// Percentage of the values (NaNs left out) that exceed the threshold; NaN where there are none.
double percentAbove(const std::vector<double>& values, double threshold);

}  // namespace softscope
