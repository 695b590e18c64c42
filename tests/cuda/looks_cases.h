// tests/cuda/looks_cases.h: first looks that an image shows moved, bent, masked, cut off, changed,
// or not at all.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "cuda/looks/looks.h"

namespace softscope::test {

/// Texture that is flat in one corner, seen with a shift, a stretch and noise.
inline GrayImage lookImage(double shift_px, double stretch, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> noise(-3, 3);
  GrayImage image(211, 161);
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) {
      const double x = (u - shift_px) * stretch, y = v + 0.4 * shift_px;
      const bool flat = u > 160 && v > 120;
      const double gray = 120 + 30 * std::sin(0.5 * x + 0.2 * y) +
                          25 * std::cos(0.45 * y - 0.17 * x) + 20 * std::sin(0.05 * x * 0.31 * y);
      image.at(u, v) = static_cast<std::uint8_t>(
          std::lround(flat ? 90 : std::min(250.0, std::max(5.0, gray + noise(random)))));
    }
  return image;
}

struct LookCases {
  explicit LookCases(unsigned seed) {
    const GrayImage first = lookImage(0, 1, seed);
    now = lookImage(1.3, 1.02, seed + 1);
    ignore = Mask(now.width_px, now.height_px, 0);
    for (int v = 60; v < 90; ++v)
      for (int u = 100; u < 118; ++u) ignore.at(u, v) = 1;
    const LookPicture picture(first, Mask());
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-5, 216), v(-5, 166), off(-6, 6), bend(-0.1, 0.1);
    for (int k = 0; k < 60; ++k) {
      const Eigen::Vector2d pixel(u(random), v(random));
      looks.push_back(FirstLook::take(picture, pixel));
      const double farther = k % 3 == 0 ? 1 : 0.2;
      Eigen::Matrix2d map = Eigen::Matrix2d::Identity();
      if (k % 4 == 0) map += Eigen::Matrix2d::NullaryExpr([&] { return bend(random); });
      sought.push_back(
          {nullptr, 59 - k, pixel + farther * Eigen::Vector2d(off(random), off(random)), map});
    }
    sought[7].pixel.x() = std::nan("");
    sought[8].image_from_look.setZero();
    looks[9] = FirstLook();
    for (std::size_t k = 0; k < looks.size(); ++k) sought[k].look = &looks[k];
  }
  LookCases(const LookCases&) = delete;

  GrayImage now;
  Mask ignore;
  std::vector<FirstLook> looks;
  std::vector<SoughtLook> sought;
};

inline void expectSameLooks(const LookCases& cases, const Mask& ignore, cuda::LookFinder* kernels) {
  const std::vector<FoundLook> expected = findLooks(cases.sought, LookPicture(cases.now, ignore));
  const std::vector<FoundLook> found = kernels->find(cases.sought, cases.now, ignore, nullptr);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(found[k].found, expected[k].found);
    if (!expected[k].found) continue;
    EXPECT_EQ(found[k].pixel, expected[k].pixel);
    EXPECT_EQ(found[k].correlation, expected[k].correlation);
    EXPECT_EQ(found[k].sigma_px, expected[k].sigma_px);
  }
}

}  // namespace softscope::test
