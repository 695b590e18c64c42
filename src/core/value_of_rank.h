// src/core/value_of_rank.h: order statistics of many numbers, on all cores.
#pragma once

#include <cstddef>
#include <vector>

namespace softscope {

/// The number of that rank (0: the least) among the absolute values of all parts together; exact.
/// The rank is below their count.
float absoluteOfRank(const std::vector<std::vector<float>>& parts, std::size_t rank);

}  // namespace softscope
