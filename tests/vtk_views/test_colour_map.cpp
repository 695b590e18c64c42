// tests/vtk_views/test_colour_map.cpp: a map that ranks values as the eye does.
#include <gtest/gtest.h>

#include <cmath>

#include "vtk_views/drawing/colour_map.h"

namespace softscope {
namespace {

double linear(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// CIE L*, 0 = black, 100 = white.
double lightness(Rgb8 c) {
  const double y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return 116 * std::cbrt(y) - 16;
}

TEST(Viridis, GetsLighterAllTheWayAndEvenly) {
  const double first = lightness(viridis(0)), last = lightness(viridis(1));
  for (int i = 1; i <= 100; ++i) {
    const double now = lightness(viridis(i / 100.0));
    EXPECT_GE(now, lightness(viridis((i - 1) / 100.0)) - 0.3) << i;  // 8-bit rounding
    EXPECT_NEAR(now, first + (last - first) * i / 100.0, 3.0) << i;  // 3 of 100: hardly visible
  }
  EXPECT_GT(last - first, 70);
}

TEST(Viridis, ClampsOutsideItsRange) {
  EXPECT_EQ(viridis(-3), viridis(0));
  EXPECT_EQ(viridis(7), viridis(1));
}

TEST(Viridis, NeverLooksLikeTheGreysOfMissingPixels) {
  for (int i = 0; i <= 100; ++i) {
    const Rgb8 c = viridis(i / 100.0);
    const int spread = std::max({c.red, c.green, c.blue}) - std::min({c.red, c.green, c.blue});
    EXPECT_GT(spread, 60) << i;  // a grey has none
  }
}

}  // namespace
}  // namespace softscope
