// src/features/match_formulas.h: formulas of the descriptor search, of the predicted shift and of
// the consistency of matches, for the CPU and the GPU.
#pragma once

#include <cmath>

#include "core/between_squares.h"
#include "core/hd.h"
#include "features/kernels.h"
#include "features/matcher_options.h"

namespace softscope {

// --- masks -----------------------------------------------------------------------------------

SOFTSCOPE_HD inline bool isDark(int gray, int darkest_gray) { return gray < darkest_gray; }

// --- descriptor search -----------------------------------------------------------------------

/// The search's options in nodes of the grid.
struct SearchReach {
  int search, elsewhere, mutual;

  /// Whether a place, seen from the centre of the search, is at its rim: the distances beyond are
  /// unknown, and mostly fall further.
  SOFTSCOPE_HD bool isAtRim(int columns, int rows) const {
    return columns == -search || columns == search || rows == -search || rows == search;
  }
};
inline SearchReach searchReach(const MatcherOptions& options, int grid_px, double radius_px) {
  const auto nodes = [&](double px) { return static_cast<int>(std::lround(px / grid_px)); };
  const int search = nodes(radius_px);
  return {search < 1 ? 1 : search, nodes(options.kElsewherePx), nodes(options.kMutualPx)};
}

/// Best distance over the best one elsewhere; below 1 = distinct.
SOFTSCOPE_HD inline float distanceRatio(int best, int elsewhere) {
  const float other = static_cast<float>(elsewhere);
  return static_cast<float>(best) / (other < 1.0f ? 1.0f : other);
}

/// Where the parabola through three neighbouring distances is lowest, in nodes; 0 at the rim.
SOFTSCOPE_HD inline float parabolaShift(int before, int best, int after) {
  if (before == kNoDistance || after == kNoDistance) return 0;
  const int curvature = before + after - 2 * best;
  return curvature > 0 ? 0.5f * static_cast<float>(before - after) / static_cast<float>(curvature)
                       : 0;
}

// --- predicted shift -------------------------------------------------------------------------

constexpr int kPredictionSquarePx = 16;  // of the shifts that a coarser level predicts

/// The square of a pixel; what lies outside counts to the border.
SOFTSCOPE_HD inline int squareOf(float px, int square_px, int count) {
  const int square = static_cast<int>(px) / square_px;
  return square < 0 ? 0 : (square < count ? square : count - 1);
}

/// Pixels of the next finer level: p -> 2 p + 1/2.
SOFTSCOPE_HD inline float toFinerPx(float px) { return 2 * px + 0.5f; }

// --- consistency -----------------------------------------------------------------------------

struct ConsistencyRules {
  float reach_sq, least_px, max_strain;
  double min_share;
};
inline ConsistencyRules consistencyRules(const ConsistencyOptions& options) {
  return {static_cast<float>(options.kReachPx * options.kReachPx),
          static_cast<float>(options.kAgreePx), static_cast<float>(options.max_strain),
          options.kMinShare};
}
/// Whether two matches, this far apart on the model, are neighbours.
template <class V>
SOFTSCOPE_FORMULA auto areNeighbours(const V& apart_u, const V& apart_v,
                                     const ConsistencyRules& r) {
  return apart_u * apart_u + apart_v * apart_v <= r.reach_sq;
}
/// Whether they moved alike: `apart` and `live_apart` are their distances on the model and in the
/// live image, `apart_px` the length of the former. V: float, or a vector of floats.
template <class V>
SOFTSCOPE_FORMULA auto movedConsistently(const V& apart_px, const V& apart_u, const V& apart_v,
                                         const V& live_apart_u, const V& live_apart_v,
                                         const ConsistencyRules& r) {
  const V agree_px = r.least_px + r.max_strain * apart_px;
  const V u = live_apart_u - apart_u, v = live_apart_v - apart_v;
  return u * u + v * v <= agree_px * agree_px;
}
SOFTSCOPE_HD inline bool moveConsistently(float apart_u, float apart_v, float live_apart_u,
                                          float live_apart_v, const ConsistencyRules& r) {
  const float apart_px = std::sqrt(apart_u * apart_u + apart_v * apart_v);
  return movedConsistently(apart_px, apart_u, apart_v, live_apart_u, live_apart_v, r);
}
SOFTSCOPE_HD inline bool isConsistent(int agreeing, int others, const ConsistencyRules& r) {
  return agreeing >= 1 && agreeing >= r.min_share * others;
}

}  // namespace softscope
