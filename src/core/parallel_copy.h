// src/core/parallel_copy.h: copies of long arrays on all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/parallel.h"

namespace softscope {

/// `to` keeps its memory where that is enough.
template <class Value>
void parallelCopy(const std::vector<Value>& from, std::vector<Value>* to) {
  constexpr int kBytesPerTask = 1 << 19;
  to->resize(from.size());
  parallelRanges(static_cast<int>(from.size()), std::max(1, kBytesPerTask / int(sizeof(Value))),
                 [&](int begin, int end) {
                   std::copy(from.begin() + begin, from.begin() + end, to->begin() + begin);
                 });
}

}  // namespace softscope
