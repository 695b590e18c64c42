// src/core/value_of_rank.h: parallel order statistics of large lists.
#pragma once

#include <cstddef>
#include <vector>

namespace softscope {

/// Value of that rank (0: smallest) among the absolute values
/// of all parts; exact. Requires a rank below their count.
float absoluteOfRank(const std::vector<std::vector<float>>& parts, std::size_t rank);

/// Median of these absolute values: the upper of the two
/// middle values for an even count; NaN without values.
float absoluteMedian(const std::vector<std::vector<float>>& parts);

}  // namespace softscope
