// src/stereo/kernels/resampling_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/kernels/resampling_kernels.h"

#include <algorithm>

#include "core/kernel_list.h"

namespace softscope {
namespace {

constexpr int kWeightBits = 12;  // one is 1 << kWeightBits
static_assert(kRowPhases == 128, "the weights below are polynomials of 1/128");

/// x / 1024, rounded.
inline int rounded(int x) { return (x + 512) >> 10; }

void mixRows(const std::uint8_t* const rows[4], const std::uint8_t* phase, int count,
             std::uint8_t* out) {
  const std::uint8_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
  for (int i = 0; i < count; ++i) {
    // (-t + 2 t² - t³) / 2, (t + 4 t² - 3 t³) / 2 and (t³ - t²) / 2 of t = p / 128.
    const int p = phase[i], p2 = p * p, p3 = p2 * p;
    const int before = -rounded(16384 * p - 256 * p2 + p3);
    const int second = rounded(16384 * p + 512 * p2 - 3 * p3);
    const int after = -rounded(128 * p2 - p3);
    const int first = (1 << kWeightBits) - before - second - after;
    const int sum = before * a[i] + first * b[i] + second * c[i] + after * d[i];
    out[i] = static_cast<std::uint8_t>(
        std::clamp((sum + (1 << (kWeightBits - 1))) >> kWeightBits, 0, 255));
  }
}

}  // namespace

extern const ResamplingKernels SOFTSCOPE_NAME(resamplingKernels, SOFTSCOPE_SIMD_SET);
const ResamplingKernels SOFTSCOPE_NAME(resamplingKernels, SOFTSCOPE_SIMD_SET) = {mixRows};

}  // namespace softscope
