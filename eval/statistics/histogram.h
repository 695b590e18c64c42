// eval/statistics/histogram.h: how many errors are of which size.
#pragma once

#include <cstddef>
#include <vector>

namespace softscope {

/// Equal bins from `low` to `high`; what lies beyond is counted beside them.
struct Histogram {
  double low = 0;
  double high = 0;
  std::vector<std::size_t> counts;  // bin i: [low + i * width, low + (i + 1) * width)
  std::size_t below = 0;
  std::size_t above = 0;  // at `high` and beyond
  std::size_t total = 0;  // values that are numbers

  double binWidth() const { return (high - low) / static_cast<double>(counts.size()); }
  /// Share of the values below the end of each bin: the cumulative distribution there.
  std::vector<double> cumulativeShares() const;
};

/// NaNs are left out. Throws OptionError unless low < high and bins >= 1.
Histogram histogram(const std::vector<double>& values, double low, double high, int bins);

}  // namespace softscope
