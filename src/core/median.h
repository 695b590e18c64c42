// src/core/median.h: the median of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace softscope {

/// The upper one of the two middle values of an even count; NaN of an empty list.
template <class Number>
Number medianOf(std::vector<Number> values) {
  if (values.empty()) return std::numeric_limits<Number>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace softscope
