// src/features/look_kernels.cpp: plain loops of fixed length that the compiler turns into
// SIMD; compiled once a set, with SOFTSCOPE_SIMD_SET naming it.
#include "features/look_kernels.h"

#include "features/lanes.h"

namespace softscope {
namespace {

constexpr int kSide = kLookSidePx, kHalf = kLookHalfPx, kPixels = kLookPixels;
constexpr int kLanes = kLookLanes;

inline Float8 splat(float x) { return Float8{} + x; }
inline Float8 splat(double x) { return Float8{} + static_cast<float>(x); }
inline Float8 at(const LookPlane& plane, int i) { return load<Float8>(plane.values + i); }

inline double total(const Float8& x) { return totalOfLanes(x); }

/// Offsets from the window's centre, and 1 for pixels off the window's edges.
struct Offsets {
  LookPlane x, y, inner;
  constexpr Offsets() : x{}, y{}, inner{} {
    for (int i = 0; i < kPixels; ++i) {
      const int column = i % kSide, row = i / kSide;
      x.values[i] = static_cast<float>(column - kHalf);
      y.values[i] = static_cast<float>(row - kHalf);
      const bool edge = column == 0 || row == 0 || column == kSide - 1 || row == kSide - 1;
      inner.values[i] = edge ? 0.0f : 1.0f;
    }
  }
};
constexpr Offsets kOffsets;

/// Positions of eight pixels relative to the integer position of the middle.
struct Places8 {
  Float8 right, down;
};
inline Places8 placesAt(const LookPlaces& places, int i) {
  const Float8 x = at(kOffsets.x, i), y = at(kOffsets.y, i);
  return {lookRight(places, x, y), lookDown(places, x, y)};
}

/// Which of eight positions the room holds; not NaN.
inline Int8 holds(const LookRoom& room, const Places8& at) {
  return (at.right >= room.left) & (at.right < room.right) & (at.down >= room.top) &
         (at.down < room.bottom);
}

/// Four pixels around each of eight positions, one in each byte.
struct Quads8 {
  Int8 pixels;
  Float8 right, down;  // fractions
};
inline Int8 floorOf(const Float8& x) {
  const Int8 whole = __builtin_convertvector(x, Int8);
  return whole + (__builtin_convertvector(whole, Float8) > x);
}
/// Positions not `inside` are moved to the middle of the image.
inline Quads8 quadsAt(const LookImage& image, const LookPlaces& places, const Places8& at,
                      const Int8& inside) {
  const Float8 right = inside ? at.right : Float8{}, down = inside ? at.down : Float8{};
  const Int8 u = floorOf(right), v = floorOf(down);
  const Int8 column = u + places.u, row = v + places.v;
  std::int32_t columns[kLanes], rows[kLanes], pixels[kLanes], held[kLanes];
  store(columns, column);
  store(rows, row);
  store(held, inside);
  for (int k = 0; k < kLanes; ++k) {
    const long place = held[k] != 0 ? static_cast<long>(rows[k]) * image.width_px + columns[k] : 0;
    std::uint16_t upper, lower;
    __builtin_memcpy(&upper, image.values + place, sizeof upper);
    __builtin_memcpy(&lower, image.values + place + image.width_px, sizeof lower);
    pixels[k] = static_cast<std::int32_t>(upper | static_cast<std::uint32_t>(lower) << 16);
  }
  return {load<Int8>(pixels), right - __builtin_convertvector(u, Float8),
          down - __builtin_convertvector(v, Float8)};
}
inline Float8 byteOf(const Int8& pixels, int k) {
  return __builtin_convertvector((pixels >> (8 * k)) & 255, Float8);
}
inline Float8 bilinear(const Quads8& quads) {
  return lookSample(byteOf(quads.pixels, 0), byteOf(quads.pixels, 1), byteOf(quads.pixels, 2),
                    byteOf(quads.pixels, 3), quads.right, quads.down);
}

void countPixels(const std::uint8_t* ignored_look, const LookImage& ignore,
                 const LookPlaces& places, float room_px, LookTemplate* look) {
  const LookRoom room = roomAround(places, ignore.width_px, ignore.height_px, room_px);
  Float8 count{};
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Places8 at = placesAt(places, i);
    const Int8 inside = holds(room, at);
    Int8 ignored = __builtin_convertvector(load<Bytes8>(ignored_look + i), Int8);
    if (ignore.values != nullptr) ignored |= quadsAt(ignore, places, at, inside).pixels;
    const Float8 weight = (inside & (ignored == 0)) ? splat(1.0f) : Float8{};
    store(look->weights.values + i, weight);
    count += weight;
  }
  look->count = total(count);
}

// --- template ------------------------------------------------------------------------------------

/// Weighted sums of some values times 1, x and y.
struct PlaneSums {
  Float8 values{}, x_values{}, y_values{};
  void add(const Float8& weighted, int i) {
    values += weighted;
    x_values += weighted * at(kOffsets.x, i);
    y_values += weighted * at(kOffsets.y, i);
  }
  ShadingPlane fit(const ShadingFit& shading) const {
    return shading.plane(total(values), total(x_values), total(y_values));
  }
};

inline Float8 at(const LookShading& shading, int i) {
  return shadingAt(shading, at(kOffsets.x, i), at(kOffsets.y, i));
}

ShadingFit shadingOver(const LookPlane& weights, double count) {
  Float8 x_sum{}, y_sum{}, xx{}, xy{}, yy{};
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 x = at(kOffsets.x, i), y = at(kOffsets.y, i), w = at(weights, i);
    const Float8 wx = w * x, wy = w * y;
    x_sum += wx;
    y_sum += wy;
    xx += wx * x;
    xy += wx * y;
    yy += wy * y;
  }
  return ShadingFit({count, total(x_sum), total(y_sum), total(xx), total(xy), total(yy)});
}

/// A window's values with as many zeros on either side as its slopes reach.
struct PaddedPlane {
  static constexpr int kMargin = 24;
  alignas(32) float values[kLookValues + 2 * kMargin] = {};
  float* inside() { return values + kMargin; }
  const float* inside() const { return values + kMargin; }
};

/// Slopes per pixel, times `scale`; 0 at the window's edges, where one-sided differences would
/// correlate with the noise of the pixel itself.
void slopesOf(const PaddedPlane& window, double scale, LookPlane* across, LookPlane* down) {
  const Float8 half = splat(0.5 * scale);
  for (int i = 0; i < kLookValues; i += kLanes) {
    const float* here = window.inside() + i;
    const Float8 inner = at(kOffsets.inner, i) * half;
    store(across->values + i, inner * (load<Float8>(here + 1) - load<Float8>(here - 1)));
    store(down->values + i, inner * (load<Float8>(here + kSide) - load<Float8>(here - kSide)));
  }
}

/// Of one slope times 1, x and y, each without shading and weighted.
void changesAlong(const LookTemplate& look, const LookPlane& slope, LookPlane* plain,
                  LookPlane* times_x, LookPlane* times_y) {
  PlaneSums sums, x_sums, y_sums;
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 weighted = at(look.weights, i) * at(slope, i);
    sums.add(weighted, i);
    x_sums.add(weighted * at(kOffsets.x, i), i);
    y_sums.add(weighted * at(kOffsets.y, i), i);
  }
  const LookShading plane = shadingOf(sums.fit(look.shading)),
                    x_plane = shadingOf(x_sums.fit(look.shading)),
                    y_plane = shadingOf(y_sums.fit(look.shading));
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 w = at(look.weights, i), value = at(slope, i);
    store(plain->values + i, w * (value - at(plane, i)));
    store(times_x->values + i, w * (value * at(kOffsets.x, i) - at(x_plane, i)));
    store(times_y->values + i, w * (value * at(kOffsets.y, i) - at(y_plane, i)));
  }
}

/// Products of change k with those from k on.
template <int k>
void productsOf(const LookPlane* changes, double (*normal)[kMapUnknowns]) {
  Float8 sums[kMapUnknowns - k] = {};
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 one = at(changes[k], i);
    for (int l = k; l < kMapUnknowns; ++l) sums[l - k] += one * at(changes[l], i);
  }
  for (int l = k; l < kMapUnknowns; ++l) normal[k][l] = normal[l][k] = total(sums[l - k]);
}

void normalOf(const LookPlane* changes, double (*normal)[kMapUnknowns]) {
  productsOf<0>(changes, normal);
  productsOf<1>(changes, normal);
  productsOf<2>(changes, normal);
  productsOf<3>(changes, normal);
  productsOf<4>(changes, normal);
  productsOf<5>(changes, normal);
}

/// Unknowns in their order: shift right and down, then the map row by row.
void changesOf(const LookTemplate& look, const PaddedPlane& window, double scale,
               LookPlane* changes) {
  LookPlane across, down;
  slopesOf(window, scale, &across, &down);
  changesAlong(look, across, &changes[0], &changes[2], &changes[3]);
  changesAlong(look, down, &changes[1], &changes[4], &changes[5]);
}

/// Products of one plane with the changes.
void productsWith(const LookPlane& one, const LookPlane* changes, double* products) {
  Float8 sums[kMapUnknowns] = {};
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 value = at(one, i);
    for (int k = 0; k < kMapUnknowns; ++k) sums[k] += value * at(changes[k], i);
  }
  for (int k = 0; k < kMapUnknowns; ++k) products[k] = total(sums[k]);
}

void describeLook(const std::uint8_t* gray, LookTemplate* look) {
  look->shading = shadingOver(look->weights, look->count);
  PaddedPlane window;
  PlaneSums sums;
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 value =
        __builtin_convertvector(__builtin_convertvector(load<Bytes8>(gray + i), Int8), Float8);
    store(window.inside() + i, value);
    sums.add(at(look->weights, i) * value, i);
  }
  const LookShading shading = shadingOf(sums.fit(look->shading));
  Float8 squares{};
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Float8 value =
        at(look->weights, i) * (load<Float8>(window.inside() + i) - at(shading, i));
    store(look->first.values + i, value);
    squares += value * value;
  }
  look->contrast = __builtin_sqrt(total(squares) / look->count);
  if (!(look->contrast > 0)) return;
  const Float8 scale = splat(1 / look->contrast);
  for (int i = 0; i < kLookValues; i += kLanes)
    store(look->first.values + i, scale * at(look->first, i));
  changesOf(*look, window, 1 / look->contrast, look->changes);
  normalOf(look->changes, look->normal);
  productsWith(look->first, look->changes, look->first_changes);
}

// --- the image -----------------------------------------------------------------------------------

bool sampleLook(const LookTemplate& look, const LookImage& image, const LookPlaces& places,
                LookSamples* samples) {
  if (places.u < 0 || places.v < 0 || places.u >= image.width_px || places.v >= image.height_px)
    return false;
  const LookRoom room = roomAround(places, image.width_px, image.height_px, 0);
  const long middle = static_cast<long>(places.v) * image.width_px + places.u;
  samples->middle = static_cast<float>(image.values[middle]);
  Int8 missed{};
  PlaneSums sums;
  Float8 squares{}, with_first{};
  for (int i = 0; i < kLookValues; i += kLanes) {
    const Places8 at8 = placesAt(places, i);
    const Int8 inside = holds(room, at8);
    const Float8 w = at(look.weights, i);
    missed |= ~inside & (w > 0);
    const Float8 value = bilinear(quadsAt(image, places, at8, inside)) - samples->middle;
    store(samples->values.values + i, value);
    const Float8 weighted = w * value;
    sums.add(weighted, i);
    squares += weighted * value;
    with_first += value * at(look.first, i);
  }
  for (int k = 0; k < kLanes; ++k)
    if (missed[k] != 0) return false;
  samples->deviation = __builtin_sqrt(takeShading(look, total(sums.values), total(sums.x_values),
                                                  total(sums.y_values), total(squares), samples));
  samples->with_first = total(with_first);
  productsWith(samples->values, look.changes, samples->with_changes);
  return true;
}

void differenceOf(const LookTemplate& look, const LookSamples& samples, LookPlane* difference) {
  const LookShading shading = shadingOf(samples.shading);
  const Float8 scale = splat(1 / samples.deviation);
  for (int i = 0; i < kLookValues; i += kLanes)
    store(difference->values + i,
          at(look.weights, i) * (scale * (at(samples.values, i) - at(shading, i))) -
              at(look.first, i));
}

// --- predicted error -----------------------------------------------------------------------------

void normalOfNoise(const LookTemplate& look, const LookPlane& difference,
                   double (*normal)[kMapUnknowns]) {
  PaddedPlane window;
  for (int i = 0; i < kLookValues; i += kLanes) store(window.inside() + i, at(difference, i));
  LookPlane changes[kMapUnknowns];
  changesOf(look, window, 1, changes);
  normalOf(changes, normal);
}

constexpr int kBox = kBoxPx, kWide = kSide + kBox - 1;  // boxes that overlap the window
constexpr int kBoxStride = 32, kBoxRows = kWide + kBox - 1;

/// Sums over five pixels of a row, for all boxes that hold one; rows above and below are 0.
void sumsAcross(const LookTemplate& look, const LookPlane& difference, const float* place,
                float* across) {
  alignas(32) float padded[kSide * kBoxStride + kBox] = {};
  LookPlane terms;
  for (int i = 0; i < kLookValues; i += kLanes) {
    Float8 change{};
    for (int k = 0; k < kMapUnknowns; ++k) change += place[k] * at(look.changes[k], i);
    store(terms.values + i, at(difference, i) * change);
  }
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      padded[y * kBoxStride + kBox - 1 + x] = terms.values[y * kSide + x];
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kBoxStride; x += kLanes) {
      const float* from = padded + y * kBoxStride + x;
      Float8 sum = load<Float8>(from);
      for (int k = 1; k < kBox; ++k) sum += load<Float8>(from + k);
      store(across + (y + kBox - 1) * kBoxStride + x, sum);
    }
}

inline Float8 sumDown(const float* across) {
  Float8 sum = load<Float8>(across);
  for (int k = 1; k < kBox; ++k) sum += load<Float8>(across + k * kBoxStride);
  return sum;
}

void boxSums(const LookTemplate& look, const LookPlane& difference,
             const float (*place)[kMapUnknowns], double* sums) {
  alignas(32) float right[kBoxRows * kBoxStride] = {}, down[kBoxRows * kBoxStride] = {};
  sumsAcross(look, difference, place[0], right);
  sumsAcross(look, difference, place[1], down);
  Float8 right_sq{}, down_sq{};
  for (int y = 0; y < kWide; ++y)
    for (int x = 0; x < kBoxStride; x += kLanes) {
      const Float8 u = sumDown(right + y * kBoxStride + x), v = sumDown(down + y * kBoxStride + x);
      right_sq += u * u;
      down_sq += v * v;
    }
  sums[0] = total(right_sq);
  sums[1] = total(down_sq);
}

}  // namespace

extern const LookKernels SOFTSCOPE_NAME(lookKernels, SOFTSCOPE_SIMD_SET);
const LookKernels SOFTSCOPE_NAME(lookKernels, SOFTSCOPE_SIMD_SET) = {
    SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET),
    countPixels,
    describeLook,
    sampleLook,
    differenceOf,
    normalOfNoise,
    boxSums};

}  // namespace softscope
