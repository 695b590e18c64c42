// src/core/value_of_rank.h: order statistics of many numbers, on all cores.
#pragma once

#include <cstddef>
#include <vector>

namespace softscope {

/// The number of that rank (0: the least) among the absolute values of all parts together; exact.
/// The rank is below their count.
float absoluteOfRank(const std::vector<std::vector<float>>& parts, std::size_t rank);

/// The median of those absolute values: the upper one of the two middle values of an even count;
/// NaN of none.
float absoluteMedian(const std::vector<std::vector<float>>& parts);

}  // namespace softscope
