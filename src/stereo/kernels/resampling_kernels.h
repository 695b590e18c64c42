// src/stereo/kernels/resampling_kernels.h: the inner loop of row resampling.
//
// Compiled once for each instruction set, under the rules of refinement_kernels.h.
#pragma once

#include <cstdint>

namespace softscope {

constexpr int kRowPhases = 128;  // of a row: 1/256 px is the largest position error

struct ResamplingKernels {
  /// Byte by byte, the value between the second and the third of four rows, after Catmull and Rom;
  /// `phase` is the distance from the second row in 1 / kRowPhases. In whole numbers.
  void (*mixRows)(const std::uint8_t* const rows[4], const std::uint8_t* phase, int count,
                  std::uint8_t* out);
};

}  // namespace softscope
