// eval/statistics/histogram.h: histogram of errors.
#pragma once

#include <cstddef>
#include <vector>

namespace softscope {

/// Equal bins from `low` to `high`; values outside are counted separately.
struct Histogram {
  double low = 0;
  double high = 0;
  std::vector<std::size_t> counts;  // bin i: [low + i * width, low + (i + 1) * width)
  std::size_t below = 0;
  std::size_t above = 0;  // at or above `high`
  std::size_t total = 0;  // values without NaNs

  double binWidth() const { return (high - low) / static_cast<double>(counts.size()); }
  /// Cumulative distribution at the end of each bin.
  std::vector<double> cumulativeShares() const;
};

/// Without NaNs. Throws OptionError unless low < high and bins >= 1.
Histogram histogram(const std::vector<double>& values, double low, double high, int bins);

}  // namespace softscope
