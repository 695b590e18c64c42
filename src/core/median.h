// src/core/median.h: median and quantile of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace softscope {

/// The upper of the two middle values for an even count; of one value or more, which it reorders.
template <class Iterator>
auto medianWithin(Iterator begin, Iterator end) {
  const Iterator middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  return *middle;
}

/// The same; NaN for an empty list.
template <class Number>
Number medianOf(std::vector<Number> values) {
  if (values.empty()) return std::numeric_limits<Number>::quiet_NaN();
  return medianWithin(values.begin(), values.end());
}

/// Value of rank floor(share * (count - 1)), where rank 0 is
/// the smallest; `share` from 0 to 1. NaN for an empty list.
template <class Number>
Number quantileOf(std::vector<Number> values, double share) {
  if (values.empty()) return std::numeric_limits<Number>::quiet_NaN();
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace softscope
