// cuda/device/fixed_sum.h: sums that any order of threads makes alike.
#pragma once

#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Whole multiples of 2^-26, up to 2^37.
using FixedSum = unsigned long long;
constexpr double kFixedUnit = 1.0 / (1 << 26);
SOFTSCOPE_HD inline FixedSum toFixed(double value) {
  return static_cast<FixedSum>(
      static_cast<long long>(value / kFixedUnit + (value < 0 ? -0.5 : 0.5)));
}
SOFTSCOPE_HD inline double fromFixed(FixedSum sum) {
  return static_cast<double>(static_cast<long long>(sum)) * kFixedUnit;
}

}  // namespace softscope::cuda
