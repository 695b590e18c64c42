// src/stereo/kernels/smoothing_kernels.h: the inner loop of patch smoothing.
//
// Compiled once for each instruction set, under the rules of refinement_kernels.h.
#pragma once

namespace softscope {

/// Four neighbouring patches (left, right, below left, below right) and the pixels between them.
struct SmoothingCell {
  float u0[4], v0[4], c[6][4];
  float variance[4];
  float share_left[4], share_right[4];  // of each at the left and at the right end of the cell
  int number;                           // along the row: CellPosition::cell
  int size;                             // of a block, in pixels
  float scale;                          // windows a pixel
};

struct SmoothingKernels {
  /// Draws the pixels [begin, end) of row v, which lie in this cell, to the patches. Arrays begin
  /// at column 0; a register beyond `end` is read and written, with what is there.
  void (*smoothCell)(const SmoothingCell& cell, int v, int begin, int end, float* disparity_px,
                     float* sigma_px);
};

}  // namespace softscope
