// eval/statistics/histogram.cpp: one pass of counting.
#include "eval/statistics/histogram.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace softscope {

Histogram histogram(const std::vector<double>& values, double low, double high, int bins) {
  require(bins >= 1, "bins", bins, "must be 1 or more");
  require(std::isfinite(low) && std::isfinite(high) && low < high, "high", high,
          "must be finite and above low");
  Histogram result;
  result.low = low;
  result.high = high;
  result.counts.assign(static_cast<std::size_t>(bins), 0);
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++result.total;
    if (value < low)
      ++result.below;
    else if (value >= high)
      ++result.above;
    else
      ++result.counts[std::min(static_cast<std::size_t>((value - low) / result.binWidth()),
                               result.counts.size() - 1)];
  }
  return result;
}

std::vector<double> Histogram::cumulativeShares() const {
  std::vector<double> shares;
  std::size_t so_far = below;
  for (const std::size_t count : counts) {
    so_far += count;
    shares.push_back(total == 0 ? 0 : static_cast<double>(so_far) / static_cast<double>(total));
  }
  return shares;
}

}  // namespace softscope
