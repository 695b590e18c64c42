// vtk_views/drawing/nice_ticks.cpp: steps of 1, 2 or 5.
#include "vtk_views/drawing/nice_ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace softscope {
namespace {

double niceStep(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double leading = rough / power;
  if (leading < 1.5) return power;
  if (leading < 3.5) return 2 * power;
  return leading < 7.5 ? 5 * power : 10 * power;
}

}  // namespace

std::string Ticks::label(double value) const {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

double roundUp(double value) {
  if (!(value > 1e-6) || !std::isfinite(value)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double leading : {1.0, 2.0, 2.5, 5.0})
    if (value <= leading * power * (1 + 1e-9)) return leading * power;
  return 10 * power;
}

Ticks niceTicks(double low, double high, int wanted) {
  if (!std::isfinite(low) || !std::isfinite(high) || low >= high)
    throw Error("axis: its range must be finite and ascending");
  const double step = niceStep((high - low) / std::max(wanted, 1));
  Ticks ticks;
  ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double slack = 1e-9 * step;  // tolerance for a bound that is a multiple of the step
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k)
    ticks.values.push_back(k * step + 0.0);  // + 0.0 avoids -0
  return ticks;
}

}  // namespace softscope
