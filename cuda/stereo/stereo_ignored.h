// cuda/stereo/stereo_ignored.h: kernel bodies for masked pixels, and windows that contain
// them.
#pragma once

#include "cuda/device/kernel.h"
#include "cuda/device/squares.h"
#include "stereo/kernels/matching_formulas.h"

namespace softscope::cuda {

/// Bits of a pixel. Input rasters contain 0 and kMasked only.
struct Ignored {
  static constexpr std::uint8_t kMasked = 1, kDense = 2, kSupport = 4;  // the window reaches one
  static constexpr int kDenseReach = kDenseWindowReach + kSobelReach;
  static constexpr int kSupportReach = kSupportMargin + kSobelReach;
  static constexpr int kFar = kSupportReach + 1;
};

/// Of a mask's value.
inline std::uint8_t ignoredBits(std::uint8_t value) { return value != 0 ? Ignored::kMasked : 0; }

/// Masked if one of the 2 x 2 pixels is.
struct HalveIgnoredBody {
  View<const std::uint8_t> whole[2];
  View<std::uint8_t> half[2];
  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    half[view].at(u, v) = bitsOfSquare(whole[view], u, v) & Ignored::kMasked;
  }
};

/// Columns to the next masked pixel of the row, at most kFar.
struct IgnoredRowBody {
  View<const std::uint8_t> ignored[2];
  View<std::uint8_t> out[2];
  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    const View<const std::uint8_t>& from = ignored[view];
    int nearest = Ignored::kFar;
    for (int x = -Ignored::kSupportReach; x <= Ignored::kSupportReach; ++x)
      if (u + x >= 0 && u + x < from.width && (from.at(u + x, v) & Ignored::kMasked) != 0) {
        const int apart = x < 0 ? -x : x;
        nearest = apart < nearest ? apart : nearest;
      }
    out[view].at(u, v) = static_cast<std::uint8_t>(nearest);
  }
};

/// Adds the bits of windows.
struct IgnoredColumnBody {
  View<const std::uint8_t> rows[2];
  View<std::uint8_t> ignored[2];
  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    const View<const std::uint8_t>& from = rows[view];
    std::uint8_t bits = ignored[view].at(u, v) & Ignored::kMasked;
    for (int y = -Ignored::kSupportReach; y <= Ignored::kSupportReach; ++y) {
      if (v + y < 0 || v + y >= from.height) continue;
      const int beside = from.at(u, v + y), apart = y < 0 ? -y : y;
      if (beside <= Ignored::kSupportReach) bits |= Ignored::kSupport;
      if (beside <= Ignored::kDenseReach && apart <= Ignored::kDenseReach) bits |= Ignored::kDense;
    }
    ignored[view].at(u, v) = bits;
  }
};

}  // namespace softscope::cuda
