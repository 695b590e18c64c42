// src/features/look_formulas.h: the search of one window of a first look, for both compilers.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/hd.h"
#include "core/small_solve.h"
#include "features/shading_plane.h"

namespace softscope {

/// Side of the windows of first looks, and what is counted with it.
constexpr int kLookHalfPx = 10, kLookSidePx = 2 * kLookHalfPx + 1;
constexpr int kLookPixels = kLookSidePx * kLookSidePx;
constexpr int kLookLanes = 8;
/// Pixels of a window up to whole registers; those beyond the window have no weight.
constexpr int kLookValues = (kLookPixels + kLookLanes - 1) / kLookLanes * kLookLanes;
constexpr int kLookLevels = 3;   // full, half and quarter size of the image
constexpr int kBoxPx = 5;        // pixels with correlated errors are within boxes of this side
constexpr int kMapUnknowns = 6;  // of a window's place: shift, and affine map row by row

constexpr int kMostLookSteps = 15;
constexpr int kMostLookRounds = 3;
constexpr double kLeastLookShare = 0.6;   // of the window's pixels
constexpr double kLeastLookContrast = 1;  // standard deviation of the window, gray levels
constexpr double kLeastLookCorrelation = 0.8;
constexpr double kLargestLookShiftPx = 4;  // from the expected position
constexpr float kLookRoomPx = static_cast<float>(kLargestLookShiftPx) + 1;
constexpr double kLargestLookSigmaPx = 0.3;  // of a position; less certain ones are often wrong

/// Place of a window in an image.
struct LookPlace {
  double u, v;    // of its middle
  double map[4];  // pixels of the image per pixel of the window, row by row
};

/// State of the search for it.
struct LookSearch {
  LookPlace place;
  bool converged;  // there, found or not
  double correlation;
  double sigma_px;  // predicted standard error along the worse axis; infinite if unknown
};
SOFTSCOPE_HD inline LookSearch searchFrom(const LookPlace& place) {
  return {place, false, 0, std::numeric_limits<double>::infinity()};
}

/// Places of a window's pixels in an image: (u, v) + (right, down) + map (x, y).
struct LookPlaces {
  int u, v;           // of the window's middle, rounded down
  float right, down;  // fractions
  float map[4];       // pixels of the image per pixel of the window, row by row
};

SOFTSCOPE_HD inline LookPlaces placesOf(const LookPlace& place) {
  const double u = std::floor(place.u), v = std::floor(place.v);
  LookPlaces places{static_cast<int>(u),
                    static_cast<int>(v),
                    static_cast<float>(place.u - u),
                    static_cast<float>(place.v - v),
                    {}};
  for (int k = 0; k < 4; ++k) places.map[k] = static_cast<float>(place.map[k]);
  return places;
}

/// Whether an image of that size has the place; false for NaN.
SOFTSCOPE_HD inline bool isInside(const LookPlace& place, int width_px, int height_px) {
  return place.u >= 0 && place.v >= 0 && place.u < width_px - 1 && place.v < height_px - 1;
}

/// Limits of positions, relative to the middle, `room_px` inside the image.
struct LookRoom {
  float left, right, top, bottom;
};
SOFTSCOPE_FORMULA LookRoom roomAround(const LookPlaces& places, int width_px, int height_px,
                                      float room_px) {
  return {room_px - static_cast<float>(places.u),
          static_cast<float>(width_px - 1 - places.u) - room_px,
          room_px - static_cast<float>(places.v),
          static_cast<float>(height_px - 1 - places.v) - room_px};
}

// Of a pixel, or of eight of them: Value is a float or a vector of floats.

/// Position relative to the integer position of the middle.
template <class Value>
SOFTSCOPE_FORMULA Value lookRight(const LookPlaces& places, const Value& x, const Value& y) {
  return places.right + (places.map[0] * x + places.map[1] * y);
}
template <class Value>
SOFTSCOPE_FORMULA Value lookDown(const LookPlaces& places, const Value& x, const Value& y) {
  return places.down + (places.map[2] * x + places.map[3] * y);
}
/// Between four pixels, row by row, with fractions.
template <class Value>
SOFTSCOPE_FORMULA Value lookSample(const Value& a, const Value& b, const Value& c, const Value& d,
                                   const Value& right, const Value& down) {
  const Value above = a + right * (b - a), below = c + right * (d - c);
  return above + down * (below - above);
}
/// A plane in single precision.
struct LookShading {
  float constant, across, down;
};
SOFTSCOPE_FORMULA LookShading shadingOf(const ShadingPlane& plane) {
  return {static_cast<float>(plane.constant), static_cast<float>(plane.across),
          static_cast<float>(plane.down)};
}
template <class Value>
SOFTSCOPE_FORMULA Value shadingAt(const LookShading& shading, const Value& x, const Value& y) {
  return shading.constant + (shading.across * x + shading.down * y);
}

// Of the whole window.

/// In an order that does not depend on the instruction set: of the sums over the pixels of each of
/// eight lanes.
template <class Lanes>
SOFTSCOPE_FORMULA double totalOfLanes(const Lanes& x) {
  return static_cast<double>(((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7])));
}

/// One window of a first look, compared by its counted pixels.
struct LookFacts {
  double count;                               // of pixels
  ShadingFit shading;                         // over them
  double contrast;                            // standard deviation without shading, gray levels
  double normal[kMapUnknowns][kMapUnknowns];  // products of the changes per unknown
  double first_changes[kMapUnknowns];         // products of the window with them
};

/// The window of an image at some places.
struct LookSighting {
  float middle;          // gray level near the window's middle, from which values are counted
  ShadingPlane shading;  // of the values
  double deviation;      // standard deviation without shading
  double with_first;     // sum of products with the first look
  double with_changes[kMapUnknowns];
};

/// Shading, and the variance that it leaves, from the weighted sums of the values, of x and y times
/// them, and of their squares.
SOFTSCOPE_FORMULA double takeShading(const LookFacts& look, double values, double x_values,
                                     double y_values, double squares, LookSighting* seen) {
  constexpr double kRounding = 1e-5;  // share of a sum of squares that may be rounding
  seen->shading = look.shading.plane(values, x_values, y_values);
  const ShadingPlane& plane = seen->shading;
  const double explained =
      plane.constant * values + plane.across * x_values + plane.down * y_values;
  const double rest = squares - explained;
  return rest > kRounding * squares ? rest / look.count : 0;
}

constexpr double kLookBendSigma = 0.1;  // of the affine map's four numbers around the expected ones
constexpr double kLookAlike = 9;        // number of neighbouring pixels with correlated errors
constexpr double kLeastLookVariance = 1e-4;  // of a pixel's difference, for a window of contrast 1

/// Variance of a pixel difference, counted as independent.
SOFTSCOPE_HD inline double lookVariance(double correlation) {
  const double variance = 2 * (1 - correlation);
  return (variance > kLeastLookVariance ? variance : kLeastLookVariance) * kLookAlike;
}

/// Factor of the information about the six unknowns: that of the pixels, less half of `noise` where
/// that isn't null, and the prior of the map. False without information.
SOFTSCOPE_HD inline bool factorInformation(const double (&normal)[kMapUnknowns][kMapUnknowns],
                                           const double (*noise)[kMapUnknowns], double variance,
                                           double (&factor)[triangleSize(kMapUnknowns)]) {
  for (int i = 0, at = 0; i < kMapUnknowns; ++i)
    for (int j = 0; j <= i; ++j, ++at) {
      factor[at] = (noise == nullptr ? normal[i][j] : normal[i][j] - 0.5 * noise[i][j]) / variance;
      if (i == j && i >= 2) factor[at] += 1 / (kLookBendSigma * kLookBendSigma);
    }
  return factorSymmetric<kMapUnknowns>(factor);
}

/// a b, both 2 x 2, row by row.
SOFTSCOPE_HD inline void multiplyMaps(const double (&a)[4], const double (&b)[4],
                                      double (&product)[4]) {
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) product[2 * i + j] = a[2 * i] * b[j] + a[2 * i + 1] * b[2 + j];
}
/// Returns the determinant of the map.
SOFTSCOPE_HD inline double invertMap(const double (&map)[4], double (&inverse)[4]) {
  const double determinant = map[0] * map[3] - map[1] * map[2], scale = 1 / determinant;
  inverse[0] = scale * map[3];
  inverse[1] = -scale * map[1];
  inverse[2] = -scale * map[2];
  inverse[3] = scale * map[0];
  return determinant;
}

SOFTSCOPE_HD inline double correlationOf(const LookFacts& look, const LookSighting& seen) {
  return seen.with_first / (seen.deviation * look.count);
}

enum class LookStep { kLost, kGoesOn, kConverged };

/// A Gauss-Newton step towards where the window agrees with what was `seen` at the place: inverse
/// compositional, with a prior around the map of `expected`.
SOFTSCOPE_HD inline LookStep stepLook(const LookFacts& look, const LookSighting& seen,
                                      const LookPlace& expected, double correlation,
                                      LookPlace* place) {
  constexpr double kConvergedPx = 0.005, kLeastDeterminant = 0.1;
  const double variance = lookVariance(correlation);
  double factor[triangleSize(kMapUnknowns)], change[kMapUnknowns], inverse[4], bend[4];
  if (!factorInformation(look.normal, nullptr, variance, factor)) return LookStep::kLost;
  invertMap(expected.map, inverse);
  multiplyMaps(inverse, place->map, bend);
  for (int k = 0; k < kMapUnknowns; ++k) {
    change[k] = (seen.with_changes[k] / seen.deviation - look.first_changes[k]) / variance;
    if (k >= 2)
      change[k] += (bend[k - 2] - (k == 2 || k == 5 ? 1 : 0)) / (kLookBendSigma * kLookBendSigma);
  }
  solveSymmetric<kMapUnknowns>(factor, change);
  const double by[4] = {1 + change[2], change[3], change[4], 1 + change[5]};
  if (!(std::fabs(invertMap(by, inverse)) > kLeastDeterminant)) return LookStep::kLost;
  const double before[4] = {place->map[0], place->map[1], place->map[2], place->map[3]};
  multiplyMaps(before, inverse, place->map);
  place->u -= place->map[0] * change[0] + place->map[1] * change[1];
  place->v -= place->map[2] * change[0] + place->map[3] * change[1];
  const double right = place->u - expected.u, down = place->v - expected.v;
  if (!(std::sqrt(right * right + down * down) < kLargestLookShiftPx)) return LookStep::kLost;
  return std::sqrt(change[0] * change[0] + change[1] * change[1]) < kConvergedPx
             ? LookStep::kConverged
             : LookStep::kGoesOn;
}

/// Change of the place, right and down, per term of a pixel; false without information. `noise`:
/// products of the changes that the slopes of the difference would make. Half of the difference is
/// the noise of the look, whose slopes counted as texture.
SOFTSCOPE_HD inline bool placePerTerm(const LookFacts& look,
                                      const double (&noise)[kMapUnknowns][kMapUnknowns],
                                      double variance, double (&place)[2][kMapUnknowns]) {
  double factor[triangleSize(kMapUnknowns)];
  if (!factorInformation(look.normal, noise, variance, factor)) return false;
  for (int axis = 0; axis < 2; ++axis) {
    for (int k = 0; k < kMapUnknowns; ++k) place[axis][k] = k == axis ? 1 : 0;
    solveSymmetric<kMapUnknowns>(factor, place[axis]);
    for (double& value : place[axis]) value /= variance;
  }
  return true;
}

/// Predicted standard error of the position along its worse axis. `boxes`: sums of the squared
/// place terms over all boxes, right and down: the variance of a sum over pixels whose errors are
/// correlated within kBoxPx (triangular kernel: Newey and West, Econometrica 1987).
SOFTSCOPE_HD inline double lookSigma(const LookFacts& look, double variance,
                                     const double (&place)[2][kMapUnknowns],
                                     const double (&boxes)[2]) {
  double largest = 0;
  for (int axis = 0; axis < 2; ++axis) {
    double bend_sq = 0, least = 0;
    for (int i = 0; i < kMapUnknowns; ++i) {
      const double bend = place[axis][i] * variance / kLookBendSigma;
      if (i >= 2) bend_sq += bend * bend;
      double row = 0;
      for (int j = 0; j < kMapUnknowns; ++j) row += look.normal[i][j] * place[axis][j];
      least += place[axis][i] * row;
    }
    const double of_axis =
        boxes[axis] / (kBoxPx * kBoxPx) + bend_sq + kLeastLookVariance * kLookAlike * least;
    if (!std::isfinite(of_axis)) return std::numeric_limits<double>::infinity();
    if (of_axis > largest) largest = of_axis;
  }
  return std::sqrt(largest);
}

// Over the sizes of an image.

/// Where a first look was found so far. Pixels are those of the full image.
struct LookFind {
  LookPlace place;
  double correlation, sigma_px;
  bool found;
};
SOFTSCOPE_HD inline LookFind noFind(const LookPlace& expected) { return {expected, 0, 0, false}; }

/// Position in the full image converted to that of a level, whose pixels are 2^level as wide.
SOFTSCOPE_HD inline double inLevel(double pixel, int level) {
  const double scale = 1 << level;
  return (pixel - (scale - 1) / 2) / scale;
}
SOFTSCOPE_HD inline double inWhole(double pixel, int level) {
  const double scale = 1 << level;
  return pixel * scale + (scale - 1) / 2;
}
/// A full place in a level; the map is the same.
SOFTSCOPE_HD inline LookPlace placeInLevel(const LookPlace& place, int level) {
  LookPlace there = place;
  there.u = inLevel(place.u, level);
  there.v = inLevel(place.v, level);
  return there;
}

/// What the search of a level adds to what the coarser ones found, in `find`. The window of half
/// size, too uncertain to count, must confirm that of a quarter: that one covers much tissue, which
/// rarely moves as one.
SOFTSCOPE_HD inline void addLevel(const LookSearch& search, bool found, int level, LookFind* find) {
  constexpr double kFarthestPx = 0.5;
  if (!found && level == 1) {
    const double right = search.place.u - inLevel(find->place.u, level),
                 down = search.place.v - inLevel(find->place.v, level);
    const bool agrees = search.converged && std::sqrt(right * right + down * down) <= kFarthestPx;
    if (!agrees) find->found = false;
  }
  if (found || !find->found) {
    find->correlation = search.correlation;
    find->sigma_px = search.sigma_px * (1 << level);
  }
  if (!found) return;
  find->found = true;
  find->place = search.place;
  find->place.u = inWhole(search.place.u, level);
  find->place.v = inWhole(search.place.v, level);
}

}  // namespace softscope
