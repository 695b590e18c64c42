// vtk_views/drawing/colour_map.cpp: seventeen colours
// with linear interpolation (within 6 of 255 steps).
#include "vtk_views/drawing/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softscope {
namespace {

constexpr std::array<Rgb8, 17> kViridis{{{68, 1, 84},
                                         {72, 24, 106},
                                         {71, 45, 123},
                                         {66, 64, 134},
                                         {59, 82, 139},
                                         {51, 99, 141},
                                         {44, 114, 142},
                                         {38, 130, 142},
                                         {33, 145, 141},
                                         {31, 159, 136},
                                         {39, 173, 129},
                                         {62, 188, 116},
                                         {93, 200, 99},
                                         {130, 211, 77},
                                         {170, 220, 50},
                                         {213, 226, 26},
                                         {253, 231, 37}}};

std::uint8_t between(std::uint8_t a, std::uint8_t b, double part) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * part));
}

}  // namespace

Rgb8 viridis(double position) {
  constexpr int kLast = static_cast<int>(kViridis.size()) - 1;
  const double place = std::clamp(position, 0.0, 1.0) * kLast;
  const int below = std::min(static_cast<int>(place), kLast - 1);
  const double part = place - below;
  return blend(kViridis[below], kViridis[below + 1], part);
}

Rgb8 blend(const Rgb8& a, const Rgb8& b, double part) {
  return {between(a.red, b.red, part), between(a.green, b.green, part),
          between(a.blue, b.blue, part)};
}

}  // namespace softscope
