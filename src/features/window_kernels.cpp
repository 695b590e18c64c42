// src/features/window_kernels.cpp: plain loops of fixed length that the compiler turns into SIMD;
// compiled once a set, with SOFTSCOPE_SIMD_SET naming it.
#include "features/window_kernels.h"

#include "core/kernel_list.h"
#include "features/lanes.h"
#include "features/subpixel_formulas.h"

namespace softscope {
namespace {

/// Value k of every vector becomes lane k's vector.
inline void transpose(Float8 (&rows)[kTemplateLanes]) {
  Float8 pairs[8], quads[8];
  for (int k = 0; k < 8; k += 2) {
    pairs[k] = __builtin_shufflevector(rows[k], rows[k + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    pairs[k + 1] = __builtin_shufflevector(rows[k], rows[k + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (int k = 0; k < 8; k += 4)
    for (int i = 0; i < 2; ++i) {
      const Float8 a = pairs[k + i], b = pairs[k + i + 2];
      quads[k + 2 * i] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
      quads[k + 2 * i + 1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int k = 0; k < 4; ++k) {
    rows[k] = __builtin_shufflevector(quads[k], quads[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    rows[k + 4] = __builtin_shufflevector(quads[k], quads[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// Pixels of all windows and the pixels around them, a window a lane.
struct LaneWindows {
  static constexpr int kSide = kLargestWindow + 2;
  Float8 values[kSide * kSide], weights[kLargestWindow * kWindowLanes];
  const Float8& at(int y, int x) const { return values[(y + 1) * kSide + x + 1]; }
  Float8 slopeU(int y, int x) const { return 0.5f * (at(y, x + 1) - at(y, x - 1)); }
  Float8 slopeV(int y, int x) const { return 0.5f * (at(y + 1, x) - at(y - 1, x)); }
};

void loadWindows(const TemplateWindows& windows, LaneWindows* lanes) {
  const int side = windows.rows + 2;
  for (int y = 0; y < side; ++y) {
    const long at = static_cast<long>(y - 1) * windows.stride - 1;
    Float8* to = lanes->values + y * LaneWindows::kSide;
    int x = 0;
    for (; x + 8 <= side; x += 8) {
      Float8 rows[kTemplateLanes];
      for (int k = 0; k < kTemplateLanes; ++k) rows[k] = load<Float8>(windows.corner[k] + at + x);
      transpose(rows);
      for (int k = 0; k < 8; ++k) to[x + k] = rows[k];
    }
    for (; x < side; ++x)
      for (int k = 0; k < kTemplateLanes; ++k) to[x][k] = windows.corner[k][at + x];
  }
  for (int i = 0; i < windows.rows * kWindowLanes; i += 8) {
    Float8 rows[kTemplateLanes];
    for (int k = 0; k < kTemplateLanes; ++k) rows[k] = load<Float8>(windows.weight[k] + i);
    transpose(rows);
    for (int k = 0; k < 8; ++k) lanes->weights[i + k] = rows[k];
  }
}

/// Of lanes, as WindowMoments of one window.
struct LaneMoments {
  Float8 mean, gradient_u, gradient_v, square, along_u, along_v;
};

LaneMoments momentsOf(const LaneWindows& lanes, int rows) {
  LaneMoments m{};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < rows; ++x) {
      const Float8 w = lanes.weights[y * kWindowLanes + x];
      m.mean += w * lanes.at(y, x);
      m.gradient_u += w * lanes.slopeU(y, x);
      m.gradient_v += w * lanes.slopeV(y, x);
    }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < rows; ++x) {
      const Float8 w = lanes.weights[y * kWindowLanes + x], t = lanes.at(y, x) - m.mean;
      m.square += w * t * t;
      m.along_u += w * t * (lanes.slopeU(y, x) - m.gradient_u);
      m.along_v += w * t * (lanes.slopeV(y, x) - m.gradient_v);
    }
  return m;
}

/// A row of every window to its own array; the columns beyond the window are 0.
inline void storeRow(Float8 (&row)[kWindowLanes], int y, float* const* to) {
  for (int x = 0; x < kWindowLanes; x += 8) {
    Float8 part[8];
    for (int k = 0; k < 8; ++k) part[k] = row[x + k];
    transpose(part);
    for (int k = 0; k < kTemplateLanes; ++k) store(to[k] + y * kWindowLanes + x, part[k]);
  }
}

void windowTemplates(const TemplateWindows& windows, TemplateResults* out) {
  LaneWindows lanes;
  loadWindows(windows, &lanes);
  const LaneMoments m = momentsOf(lanes, windows.rows);
  Float8 uu{}, uv{}, vu{}, vv{};
  Float8 steepest_u[kWindowLanes] = {}, steepest_v[kWindowLanes] = {}, contrast[kWindowLanes] = {};
  for (int y = 0; y < windows.rows; ++y) {
    for (int x = 0; x < windows.rows; ++x) {
      const Float8 w = lanes.weights[y * kWindowLanes + x], t = lanes.at(y, x) - m.mean;
      const Float8 u = projectedGradient<Float8>(lanes.slopeU(y, x), m.gradient_u, t, m.along_u,
                                                 m.square),
                   v = projectedGradient<Float8>(lanes.slopeV(y, x), m.gradient_v, t, m.along_v,
                                                 m.square);
      uu += w * u * u;
      uv += w * u * v;
      vu += w * v * u;
      vv += w * v * v;
      steepest_u[x] = w * u;
      steepest_v[x] = w * v;
      contrast[x] = w * t;
    }
    storeRow(steepest_u, y, out->steepest_u);
    storeRow(steepest_v, y, out->steepest_v);
    storeRow(contrast, y, out->contrast);
  }
  store(out->contrast_sq, m.square);
  store(out->uu, uu);
  store(out->uv, uv);
  store(out->vu, vu);
  store(out->vv, vv);
}

inline float total(const float* lanes) {
  float sum = 0;
  for (int k = 0; k < kWindowLanes; ++k) sum += lanes[k];
  return sum;
}

WindowSums windowSums(const WindowTemplate& fixed, const float* corner, int stride,
                      float fraction_u, float fraction_v) {
  float along_u[kWindowLanes] = {}, along_v[kWindowLanes] = {}, contrast[kWindowLanes] = {};
  float mean[kWindowLanes] = {}, square[kWindowLanes] = {};
  for (int y = 0; y < fixed.rows; ++y) {
    const float* upper = corner + static_cast<long>(y) * stride;
    const float* lower = upper + stride;
    const long at = static_cast<long>(y) * kWindowLanes;
    for (int k = 0; k < kWindowLanes; ++k) {
      const float value =
          bilinear(upper[k], upper[k + 1], lower[k], lower[k + 1], fraction_u, fraction_v);
      along_u[k] += fixed.steepest_u[at + k] * value;
      along_v[k] += fixed.steepest_v[at + k] * value;
      contrast[k] += fixed.contrast[at + k] * value;
      mean[k] += fixed.weight[at + k] * value;
      square[k] += fixed.weight[at + k] * value * value;
    }
  }
  return {total(along_u), total(along_v), total(contrast), total(mean), total(square)};
}

}  // namespace

extern const WindowKernels SOFTSCOPE_NAME(windowKernels, SOFTSCOPE_SIMD_SET);
const WindowKernels SOFTSCOPE_NAME(windowKernels, SOFTSCOPE_SIMD_SET) = {windowTemplates,
                                                                         windowSums};

}  // namespace softscope
