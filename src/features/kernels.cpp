// src/features/kernels.cpp: plain loops of fixed length that the compiler turns into SIMD;
// compiled once a set, with SOFTSCOPE_SIMD_SET naming it.
#include "features/kernels.h"

#include "features/lanes.h"
#include "features/match_formulas.h"
#include "features/surf_formulas.h"
#include "features/view_formulas.h"

namespace softscope {
namespace {

constexpr int kLanes = kSplatLanes;
template <class Value>
inline void add8(Value* to, const Float8& values) {
  store(to, load<Float8>(to) + values);
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
        const Float8 front = load<Float8>(row + g * kLanes);
        const Int8 nearer = (x * x + y * y < radius_sq) & (depth > front);
        store(row + g * kLanes, nearer ? depth : front);
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
  const Float8 front = load<Float8>(band.front + at);
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
  const Float8 best = load<Float8>(band.best_weight + at);
  const Int8 better = w > best;
  const Int8 point = load<Int8>(band.point + at);
  store(band.point + at, better ? disc.point + Int8{} : point);
  store(band.best_weight + at, better ? w : best);
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
    haarAt(rows, u, load<Int8, std::int32_t>, &across, &down, &invalid);
    const Int8 kept = invalid == 0;
    store(du + u, across & kept);
    store(dv + u, down & kept);
    store(valid + u, kept & 1);
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

inline std::uint16_t distanceOf(const std::uint8_t* one, const std::uint8_t* other) {
  int sum = 0;
  for (int k = 0; k < kDescriptorSize; ++k) {
    const int difference = one[k] - other[k];
    sum += difference < 0 ? -difference : difference;
  }
  return static_cast<std::uint16_t>(sum);
}

#ifdef __AVX2__
/// Four partial sums of absolute differences of one pair.
inline Quads partialDistances(const Bytes32& low, const Bytes32& high, const std::uint8_t* other) {
  // Both compilers have the instruction under this name, with vectors of different elements.
  return reinterpret_cast<Quads>(__builtin_ia32_psadbw256(low, load<Bytes32>(other))) +
         reinterpret_cast<Quads>(__builtin_ia32_psadbw256(high, load<Bytes32>(other + 32)));
}
#endif

void descriptorDistances(const std::uint8_t* one, const std::uint8_t* others, int count,
                         std::uint16_t* distances) {
  int j = 0;
#ifdef __AVX2__
  const Bytes32 low = load<Bytes32>(one), high = load<Bytes32>(one + 32);
  for (; j + 4 <= count; j += 4) {  // distances have 14 bits: four at once in each 64
    const std::uint8_t* other = others + kDescriptorSize * static_cast<long>(j);
    const Quads four = partialDistances(low, high, other) |
                       partialDistances(low, high, other + kDescriptorSize) << 16 |
                       partialDistances(low, high, other + 2 * kDescriptorSize) << 32 |
                       partialDistances(low, high, other + 3 * kDescriptorSize) << 48;
    store(distances + j, (four[0] + four[2]) + (four[1] + four[3]));
  }
#endif
  for (; j < count; ++j)
    distances[j] = distanceOf(one, others + kDescriptorSize * static_cast<long>(j));
}

/// Nodes that are not valid have no distance.
inline void dropInvalid(const std::uint8_t* valid, int columns, std::uint16_t* distances) {
  int c = 0;
  for (; c + 8 <= columns; c += 8) {
    const Words8 marks = __builtin_convertvector(load<Bytes8>(valid + c), Words8);
    store(distances + c, load<Words8>(distances + c) | reinterpret_cast<Words8>(marks == 0));
  }
  for (; c < columns; ++c) distances[c] = valid[c] != 0 ? distances[c] : kNoDistance;
}

NearestNode searchWindow(const std::uint8_t* one, const DescriptorWindow& window,
                         const WindowDistances& distances) {
  const Words16 none = Words16{} + static_cast<std::uint16_t>(kNoDistance);
  const int groups = distances.stride / kDistanceLanes;
  Words16 least = none, group_of_least{};
  for (int r = 0; r < window.rows; ++r) {
    std::uint16_t* to = distances.values + static_cast<long>(r) * distances.stride;
    const long node = static_cast<long>(r) * window.grid_columns;
    store(to + distances.stride - kDistanceLanes, none);
    descriptorDistances(one, window.others + kDescriptorSize * node, window.columns, to);
    dropInvalid(window.valid + node, window.columns, to);
    for (int g = 0; g < groups; ++g) {
      const Words16 here = load<Words16>(to + kDistanceLanes * g);
      const auto less = here < least;
      const std::uint16_t group = static_cast<std::uint16_t>(r * groups + g);
      group_of_least = less ? Words16{} + group : group_of_least;
      least = less ? here : least;
    }
  }
  NearestNode nearest{kNoDistance, 0, 0};
  for (int k = 0; k < kDistanceLanes; ++k) {
    const int row = group_of_least[k] / groups,
              column = group_of_least[k] % groups * kDistanceLanes + k;
    const bool earlier = row < nearest.row || (row == nearest.row && column < nearest.column);
    if (least[k] < nearest.distance || (least[k] == nearest.distance && earlier))
      nearest = {least[k], column, row};
  }
  return nearest;
}

int secondBestDistance(const WindowDistances& distances, int rows, const NearestNode& node,
                       int reach) {
  Words16 least = Words16{} + static_cast<std::uint16_t>(kNoDistance);
  for (int g = 0; g < distances.stride / kDistanceLanes; ++g) {
    Words16 near{};
    for (int k = 0; k < kDistanceLanes; ++k) {
      const int apart = g * kDistanceLanes + k - node.column;
      near[k] = apart >= -reach && apart <= reach ? kNoDistance : 0;
    }
    for (int r = 0; r < rows; ++r) {
      const std::uint16_t* row = distances.values + static_cast<long>(r) * distances.stride;
      const bool near_row = r >= node.row - reach && r <= node.row + reach;
      const Words16 here = load<Words16>(row + kDistanceLanes * g) | (near_row ? near : Words16{});
      least = here < least ? here : least;
    }
  }
  int smallest = kNoDistance;
  for (int k = 0; k < kDistanceLanes; ++k) smallest = smaller(smallest, least[k]);
  return smallest;
}

// --- consistency ------------------------------------------------------------------------------

inline Float8 squareRoot(Float8 x) {
  for (int k = 0; k < 8; ++k) x[k] = __builtin_sqrtf(x[k]);
  return x;
}

NeighbourCounts countNeighbours(const MatchPlaces& places, int count, const MatchPlaces& own,
                                const ConsistencyRules& rules) {
  Int8 others{}, agreeing{};
  const Float8 last = Float8{} + static_cast<float>(count);
  for (int i = 0; i < count; i += 8) {
    const Float8 u = load<Float8>(places.model_u + i) - *own.model_u,
                 v = load<Float8>(places.model_v + i) - *own.model_v;
    const Int8 near =
        areNeighbours<Float8>(u, v, rules) & (kCounting + static_cast<float>(i) < last);
    others -= near;
    agreeing -=
        near & movedConsistently<Float8>(squareRoot(u * u + v * v), u, v,
                                         load<Float8>(places.live_u + i) - *own.live_u,
                                         load<Float8>(places.live_v + i) - *own.live_v, rules);
  }
  NeighbourCounts counts{0, 0};
  for (int k = 0; k < 8; ++k) {
    counts.others += others[k];
    counts.agreeing += agreeing[k];
  }
  return counts;
}

}  // namespace

extern const WindowKernels SOFTSCOPE_NAME(windowKernels, SOFTSCOPE_SIMD_SET);
extern const FeatureKernels SOFTSCOPE_NAME(featureKernels, SOFTSCOPE_SIMD_SET);
const FeatureKernels SOFTSCOPE_NAME(featureKernels, SOFTSCOPE_SIMD_SET) = {
    SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET),
    splatFront,
    splatBlend,
    haarRow,
    describe,
    descriptorDistances,
    searchWindow,
    secondBestDistance,
    countNeighbours,
    &SOFTSCOPE_NAME(windowKernels, SOFTSCOPE_SIMD_SET)};

}  // namespace softscope
