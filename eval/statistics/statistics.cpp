// eval/statistics/statistics.cpp: sums in double, percentiles by partial sorting.
#include "eval/statistics/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

/// Reorders the numbers. Requires at least one.
double percentileOf(std::vector<double>& numbers, double percent) {
  const double place = percent / 100 * static_cast<double>(numbers.size() - 1);
  const auto rank = static_cast<std::ptrdiff_t>(std::floor(place));
  std::nth_element(numbers.begin(), numbers.begin() + rank, numbers.end());
  const double below = numbers[static_cast<std::size_t>(rank)];
  const double part = place - static_cast<double>(rank);
  if (part == 0) return below;
  const double above = *std::min_element(numbers.begin() + rank + 1, numbers.end());
  return below + part * (above - below);
}

}  // namespace

std::vector<double> withoutNaN(const std::vector<double>& values) {
  std::vector<double> numbers;
  numbers.reserve(values.size());
  for (const double value : values)
    if (!std::isnan(value)) numbers.push_back(value);
  return numbers;
}

Statistics statistics(const std::vector<double>& values) {
  std::vector<double> numbers = withoutNaN(values);
  Statistics result;
  result.count = numbers.size();
  result.nan_count = values.size() - numbers.size();
  if (numbers.empty()) return result;

  const double n = static_cast<double>(numbers.size());
  double sum = 0, squares = 0, deviations = 0;
  for (const double x : numbers) {
    sum += x;
    squares += x * x;
  }
  result.mean = sum / n;
  for (const double x : numbers) deviations += (x - result.mean) * (x - result.mean);
  result.sd = std::sqrt(deviations / n);
  result.rmse = std::sqrt(squares / n);
  const auto range = std::minmax_element(numbers.begin(), numbers.end());
  result.min = *range.first;
  result.max = *range.second;
  result.median = percentileOf(numbers, 50);
  result.p95 = percentileOf(numbers, 95);
  return result;
}

std::vector<double> percentiles(const std::vector<double>& values,
                                const std::vector<double>& percents) {
  for (const double percent : percents)
    require(percent >= 0 && percent <= 100, "percent", percent, "must be from 0 to 100");
  std::vector<double> numbers = withoutNaN(values), result;
  for (const double percent : percents)
    result.push_back(numbers.empty() ? Statistics::kNone : percentileOf(numbers, percent));
  return result;
}

double percentAbove(const std::vector<double>& values, double threshold) {
  std::size_t count = 0, above = 0;
  for (const double value : values) {
    count += !std::isnan(value);
    above += value > threshold;
  }
  return count == 0 ? Statistics::kNone
                    : 100.0 * static_cast<double>(above) / static_cast<double>(count);
}

}  // namespace softscope
