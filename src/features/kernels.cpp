// src/features/kernels.cpp: plain loops of fixed length that the compiler turns into SIMD;
// compiled once a set, with SOFTSCOPE_SIMD_SET naming it.
#include "features/kernels.h"

#include "features/subpixel_formulas.h"
#include "features/surf_formulas.h"
#include "features/view_formulas.h"

#define SOFTSCOPE_NAME_(set) featureKernels_##set
#define SOFTSCOPE_NAME(set) SOFTSCOPE_NAME_(set)
#define SOFTSCOPE_TEXT_(set) #set
#define SOFTSCOPE_TEXT(set) SOFTSCOPE_TEXT_(set)

namespace softscope {
namespace {

constexpr int kLanes = kSplatLanes;
typedef float Float8 __attribute__((vector_size(32)));
typedef std::int32_t Int8 __attribute__((vector_size(32)));

template <class Vector, class Value>
inline Vector load8(const Value* from) {
  Vector values;
  __builtin_memcpy(&values, from, sizeof(values));
  return values;
}
template <class Vector, class Value>
inline void store8(Value* to, const Vector& values) {
  __builtin_memcpy(to, &values, sizeof(values));
}
template <class Value>
inline void add8(Value* to, const Float8& values) {
  store8(to, load8<Float8>(to) + values);
}
constexpr Float8 kCounting = {0, 1, 2, 3, 4, 5, 6, 7};

// --- model view -------------------------------------------------------------------------------

inline int larger(int a, int b) { return a > b ? a : b; }
inline int smaller(int a, int b) { return a < b ? a : b; }

inline DiscBox boxOf(const SplatDisc& disc, const SplatBand& band) {
  DiscBox box = discBox(disc);
  box.v0 = larger(box.v0, band.first_row);
  box.v1 = smaller(box.v1, band.first_row + band.rows - 1);
  return box;
}

void splatFront(const SplatDisc* discs, int count, const SplatBand& band) {
  for (int i = 0; i < count; ++i) {
    const SplatDisc disc = discs[i];
    const DiscBox box = boxOf(disc, band);
    const float radius_sq = disc.radius_px * disc.radius_px;
    for (int v = box.v0; v <= box.v1; ++v) {
      const float y = static_cast<float>(v) - disc.v_px;
      float* row = band.front + static_cast<long>(v - band.first_row) * band.stride + box.u0;
      for (int g = 0; g < box.groups; ++g) {
        const Float8 x = kCounting + (static_cast<float>(box.u0 + g * kLanes) - disc.u_px);
        const Float8 depth = discInverseDepth(disc, x, y);
        const Float8 front = load8<Float8>(row + g * kLanes);
        const Int8 nearer = (x * x + y * y < radius_sq) & (depth > front);
        store8(row + g * kLanes, nearer ? depth : front);
      }
    }
  }
}

/// Eight pixels of a disc, which begin `at` values into the band's planes.
inline void blendLanes(const SplatDisc& disc, const SplatBand& band, long at, const Float8& x,
                       float y, float inverse_radius_sq) {
  const Float8 none{};
  const Float8 depth = discInverseDepth(disc, x, y);
  const Float8 falloff = discFalloff(x, y, inverse_radius_sq);
  const Float8 front = load8<Float8>(band.front + at);
  const Float8 limit = frontLimit(front, band.tolerance_mm);
  const Float8 w = ((falloff > 0) & (depth >= limit)) ? falloff * falloff : none;
  add8(band.weight + at, w);
  add8(band.red + at, w * disc.red);
  add8(band.green + at, w * disc.green);
  add8(band.blue + at, w * disc.blue);
  add8(band.anchor + at, w * disc.anchor);
  add8(band.inverse_depth + at, w * depth);
  add8(band.shift_u + at, w * x);
  add8(band.shift_v + at, w * y);
  const Float8 best = load8<Float8>(band.best_weight + at);
  const Int8 better = w > best;
  const Int8 point = load8<Int8>(band.point + at);
  store8(band.point + at, better ? disc.point + Int8{} : point);
  store8(band.best_weight + at, better ? w : best);
}

void splatBlend(const SplatDisc* discs, int count, const SplatBand& band) {
  for (int i = 0; i < count; ++i) {
    const SplatDisc disc = discs[i];
    const DiscBox box = boxOf(disc, band);
    const float inverse_radius_sq = 1 / (disc.radius_px * disc.radius_px);
    for (int v = box.v0; v <= box.v1; ++v)
      for (int g = 0; g < box.groups; ++g) {
        const int u = box.u0 + g * kLanes;
        blendLanes(disc, band, static_cast<long>(v - band.first_row) * band.stride + u,
                   kCounting + (static_cast<float>(u) - disc.u_px),
                   static_cast<float>(v) - disc.v_px, inverse_radius_sq);
      }
  }
}

// --- dense SURF -------------------------------------------------------------------------------

/// Four corners of the integral image's rectangles that two wavelets share.
struct HaarRows {
  const std::int32_t *top, *middle, *bottom, *invalid_top, *invalid_bottom;
  int h;
};

template <class Value, class Load>
inline void haarAt(const HaarRows& rows, int u, const Load& load, Value* du, Value* dv,
                   Value* invalid) {
  const int h = rows.h;
  const Value top_left = load(rows.top + u - h), top_right = load(rows.top + u + h);
  const Value bottom_left = load(rows.bottom + u - h), bottom_right = load(rows.bottom + u + h);
  const Value left = load(rows.bottom + u) - bottom_left - load(rows.top + u) + top_left;
  const Value upper = load(rows.middle + u + h) - load(rows.middle + u - h) - top_right + top_left;
  const Value all = bottom_right - bottom_left - top_right + top_left;
  *invalid = load(rows.invalid_bottom + u + h) - load(rows.invalid_bottom + u - h) -
             load(rows.invalid_top + u + h) + load(rows.invalid_top + u - h);
  *du = haarResponse(all, left);
  *dv = haarResponse(all, upper);
}

void haarRow(const std::int32_t* top, const std::int32_t* middle, const std::int32_t* bottom,
             const std::int32_t* invalid_top, const std::int32_t* invalid_bottom, int h, int count,
             std::int32_t* du, std::int32_t* dv, std::int32_t* valid) {
  const HaarRows rows{top, middle, bottom, invalid_top, invalid_bottom, h};
  int u = 0;
  for (; u + kLanes <= count; u += kLanes) {
    Int8 across, down, invalid;
    haarAt(rows, u, load8<Int8, std::int32_t>, &across, &down, &invalid);
    const Int8 kept = invalid == 0;
    store8(du + u, across & kept);
    store8(dv + u, down & kept);
    store8(valid + u, kept & 1);
  }
  for (; u < count; ++u) {
    std::int32_t across, down, invalid;
    haarAt(
        rows, u, [](const std::int32_t* at) { return *at; }, &across, &down, &invalid);
    du[u] = invalid == 0 ? across : 0;
    dv[u] = invalid == 0 ? down : 0;
    valid[u] = invalid == 0 ? 1 : 0;
  }
}

float describe(const float* const* rows, int step, std::uint8_t* __restrict bytes) {
  float values[kDescriptorSize];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) values[16 * i + 4 * j + k] = rows[i][j * step + k];
  float lanes[8] = {};
  for (int k = 0; k < kDescriptorSize; k += 8)
    for (int l = 0; l < 8; ++l) lanes[l] += values[k + l] * values[k + l];
  const float length = __builtin_sqrtf(sumOfLanes(lanes));
  const float scale = descriptorScale(length);
  for (int k = 0; k < kDescriptorSize; ++k) bytes[k] = descriptorByte(values[k], scale);
  return length;
}

void descriptorDistances(const std::uint8_t* one, const std::uint8_t* others, int count,
                         std::uint16_t* distances) {
  for (int j = 0; j < count; ++j) {
    const std::uint8_t* other = others + 64L * j;
    int sum = 0;
    for (int k = 0; k < 64; ++k) {
      const int difference = one[k] - other[k];
      sum += difference < 0 ? -difference : difference;
    }
    distances[j] = static_cast<std::uint16_t>(sum);
  }
}

// --- sub-pixel windows ------------------------------------------------------------------------

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

extern const FeatureKernels SOFTSCOPE_NAME(SOFTSCOPE_SIMD_SET);
const FeatureKernels SOFTSCOPE_NAME(SOFTSCOPE_SIMD_SET) = {SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET),
                                                           splatFront,
                                                           splatBlend,
                                                           haarRow,
                                                           describe,
                                                           descriptorDistances,
                                                           windowSums};

}  // namespace softscope
