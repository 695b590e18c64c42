// src/stereo/kernels/normal_kernels.h: the inner loops of normals from depth.
//
// Compiled once for each instruction set, under the rules of refinement_kernels.h.
#pragma once

#include "stereo/kernels/refinement_kernels.h"

namespace softscope {

/// Terms of a row of inverse depth before the sums over windows.
struct InverseDepthRow {
  const float* depth_mm;  // NaN if unmeasured
  int width;
  float* inverse;   // 1 / depth; NaN if unmeasured
  float* weighted;  // the same, 0 if unmeasured
  float* measured;  // 1 or 0
};

/// A row of planes fitted to inverse depth: n . X = k with X = z ((u - cx) / fx, (v - cy) / fy, 1)
/// gives 1/z linear in u and v.
struct NormalRow {
  MomentRow moments;     // of measured (six) and of inverse depth (three)
  const float* inverse;  // NaN: no normal
  int width;
  float fewest_pixels;  // NaN if the window has fewer
  float fx_px, fy_px, cx_px;
  float dv_px;       // v - cy
  float* normal[3];  // unit, towards the camera
};

struct NormalKernels {
  void (*invertRow)(const InverseDepthRow& row);
  /// mixed[u] = 1 where a value of the window differs from the centre by more
  /// than `share` of the centre. `rows` as in columnMoments(); `low` and `high`
  /// are scratch, readable and writable `radius` beyond both ends, and NaN there.
  void (*findMixed)(const float* const* rows, int radius, int width, float share, float* low,
                    float* high, unsigned char* mixed);
  void (*solveNormals)(const NormalRow& row);
};

}  // namespace softscope
