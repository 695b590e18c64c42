// vtk_views/drawing/nice_ticks.h: round tick values of an axis.
#pragma once

#include <string>
#include <vector>

namespace softscope {

struct Ticks {
  std::vector<double> values;  // ascending, multiples of 1, 2 or 5 times a power of ten
  int decimals = 0;            // needed to distinguish them

  std::string label(double value) const;
};

/// About `wanted` ticks in [low, high]. Throws Error unless low < high and both are finite.
Ticks niceTicks(double low, double high, int wanted);

/// 1, 2, 2.5 or 5 times a power of ten, at least `value`: end of a
/// colour bar. 1 for a value that is not finite or below 0.000001.
double roundUp(double value);

}  // namespace softscope
