// src/core/between_squares.h: values of squares of pixels, between the centres of the squares.
#pragma once

#include "core/hd.h"

namespace softscope {

/// Squares on either side of a place, and its share of the second one.
struct BetweenSquares {
  int first, second;
  float share;
};
SOFTSCOPE_HD inline BetweenSquares betweenSquares(float px, int square_px, int count) {
  const float last = static_cast<float>(count - 1);
  float place = (px + 0.5f) / static_cast<float>(square_px) - 0.5f;
  place = place < 0.0f ? 0.0f : (last < place ? last : place);
  const int first = static_cast<int>(place);
  return {first, first + 1 < count ? first + 1 : count - 1, place - static_cast<float>(first)};
}
/// Bilinear between four squares, one coordinate of the shift.
SOFTSCOPE_HD inline float mixSquares(float upper_left, float upper_right, float lower_left,
                                     float lower_right, float across, float down) {
  return (1 - down) * ((1 - across) * upper_left + across * upper_right) +
         down * ((1 - across) * lower_left + across * lower_right);
}

}  // namespace softscope
