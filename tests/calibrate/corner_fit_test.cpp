// tests/calibrate/corner_fit_test.cpp: corners drawn by formula, found from nearby positions.
#include "calibrate/corner_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace softscope::test {
namespace {

constexpr double kContrast = 85, kBlurPx = 0.9;

/// Two edges through `corner`, of these directions; levels 40 to 210 on a slope of 1 a pixel.
GrayImage drawnCorner(const Eigen::Vector2d& corner, double angle_1, double angle_2,
                      double noise_levels, unsigned seed) {
  GrayImage image(31, 31);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  const auto side = [&](const Eigen::Vector2d& offset, double angle) {
    const double distance = -std::sin(angle) * offset.x() + std::cos(angle) * offset.y();
    return std::erf(distance / (M_SQRT2 * kBlurPx));
  };
  for (int v = 0; v < 31; ++v)
    for (int u = 0; u < 31; ++u) {
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - corner;
      const double level = 125 + offset.x() +
                           kContrast * side(offset, angle_1) * side(offset, angle_2) +
                           noise_levels * noise(random);
      image.at(u, v) =
          static_cast<std::uint8_t>(std::lround(std::min(255.0, std::max(0.0, level))));
    }
  return image;
}

CornerStart beside(const Eigen::Vector2d& corner, double angle_1, double angle_2) {
  return {corner + Eigen::Vector2d(0.4, -0.3),
          {std::cos(angle_1 + 0.05), std::sin(angle_1 + 0.05)},
          {std::cos(angle_2 - 0.05), std::sin(angle_2 - 0.05)}};
}

TEST(CornerFit, FindsACornerToHundredthsOfAPixel) {
  double squares = 0;
  int count = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Eigen::Vector2d corner(15.3 - 0.02 * seed, 14.8 + 0.015 * seed);
    const double angle_1 = 0.03 * seed - 0.4, angle_2 = angle_1 + 1.2 + 0.02 * seed;
    const GrayImage image = drawnCorner(corner, angle_1, angle_2, 3, seed);
    const Eigen::Vector2d found = fitCorner(image, beside(corner, angle_1, angle_2), 9);
    squares += (found - corner).squaredNorm();
    count += 2;
  }
  // Two edges of 18 px at this contrast, blur and noise hold 0.009 px a coordinate.
  EXPECT_LT(std::sqrt(squares / count), 0.015);
}

TEST(CornerFit, StaysAtItsStartWhereThereIsNoCorner) {
  const Eigen::Vector2d corner(15, 15);
  const CornerStart start = beside(corner, 0, M_PI / 2);
  EXPECT_EQ(fitCorner(GrayImage(31, 31, 120), start, 9), start.pixel);
  EXPECT_EQ(fitCorner(drawnCorner({25, 15}, 0, M_PI / 2, 0, 1), start, 9), start.pixel);
  CornerStart at_rim = start;
  at_rim.pixel = {4, 15};
  EXPECT_EQ(fitCorner(drawnCorner({4, 15}, 0, M_PI / 2, 0, 1), at_rim, 9), at_rim.pixel);
}

}  // namespace
}  // namespace softscope::test
