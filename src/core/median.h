// src/core/median.h: median and quantile of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace softscope {

/// The upper of the two middle values for an even count; NaN for an empty list.
template <class Number>
Number medianOf(std::vector<Number> values) {
  if (values.empty()) return std::numeric_limits<Number>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
