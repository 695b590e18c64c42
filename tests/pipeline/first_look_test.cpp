// tests/pipeline/first_look_test.cpp: a window of the first image is found again.
#include "pipeline/first_look.h"

#include <gtest/gtest.h>

#include <cmath>

namespace softscope {
namespace {

const Eigen::Vector2d kMiddle(60, 50);

/// Brightness of a tissue at a place of the first image.
double textureAt(double u, double v) {
  return 120 + 30 * std::sin(0.5 * u + 0.2 * v) + 25 * std::cos(0.45 * v - 0.17 * u) +
         15 * std::sin(0.21 * u * 0.9 + 0.33 * v);
}

/// Pixel p of the image shows the place kMiddle + map^-1 (p - at) of the first image.
GrayImage imageOf(const Eigen::Vector2d& at, const Eigen::Matrix2d& map, double gain = 1,
                  double offset = 0) {
  GrayImage image(120, 100);
  const Eigen::Matrix2d back = map.inverse();
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) {
      const Eigen::Vector2d place = kMiddle + back * (Eigen::Vector2d(u, v) - at);
      image.at(u, v) =
          static_cast<std::uint8_t>(std::lround(offset + gain * textureAt(place.x(), place.y())));
    }
  return image;
}

FirstLook firstLook() {
  return FirstLook::take(imageOf(kMiddle, Eigen::Matrix2d::Identity()), Mask(), kMiddle);
}

TEST(FirstLook, IsFoundWhereItIsToATwentiethOfAPixel) {
  Eigen::Matrix2d map;
  map << 1.1, 0.05, -0.08, 0.95;
  const Eigen::Vector2d at(63.3, 48.6);
  const GrayImage image = imageOf(at, map);
  const FoundLook found =
      findLook(firstLook(), image, Mask(), at + Eigen::Vector2d(1.4, -1.1), map);
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.pixel - at).norm(), 0.05);
  EXPECT_GT(found.correlation, 0.99);
  EXPECT_LT(found.sigma_px, 0.1);
}

TEST(FirstLook, IsFoundThoughItTurnsAndStretchesUnexpectedly) {
  Eigen::Matrix2d map;
  map << 1.08, 0.1, -0.06, 0.94;
  const Eigen::Vector2d at(61.2, 50.7);
  const FoundLook found =
      findLook(firstLook(), imageOf(at, map), Mask(), kMiddle, Eigen::Matrix2d::Identity());
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.pixel - at).norm(), 0.05);
}

TEST(FirstLook, BearsOtherLight) {
  const Eigen::Vector2d at(60.8, 49.5);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  const FoundLook found = findLook(firstLook(), imageOf(at, same, 0.6, 30), Mask(), kMiddle, same);
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.pixel - at).norm(), 0.05);
}

// A highlight of 5 x 5 pixels: unmasked it pulls, masked it does not count.
TEST(FirstLook, LeavesOutWhatIsMasked) {
  const Eigen::Vector2d at(60.5, 50.5);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  GrayImage image = imageOf(at, same);
  Mask mask(image.width_px, image.height_px);
  for (int v = 46; v <= 50; ++v)
    for (int u = 62; u <= 66; ++u) {
      image.at(u, v) = 255;
      mask.at(u, v) = 1;
    }
  const FoundLook found = findLook(firstLook(), image, mask, kMiddle, same);
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.pixel - at).norm(), 0.05);
}

TEST(FirstLook, IsNotFoundWhereItIsNot) {
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  const FirstLook look = firstLook();
  const GrayImage image = imageOf(kMiddle, same);
  const auto expectNothing = [&](const FoundLook& found, const char* why) {
    EXPECT_FALSE(found.found) << why;
    EXPECT_EQ(found.pixel, kMiddle) << why;
  };
  expectNothing(findLook(look, GrayImage(120, 100, 90), Mask(), kMiddle, same), "no texture");
  expectNothing(findLook(look, image, Mask(120, 100, 1), kMiddle, same), "all masked");
  expectNothing(findLook(look, imageOf({66, 53}, same), Mask(), kMiddle, same), "too far");
  expectNothing(findLook(FirstLook(), image, Mask(), kMiddle, same), "no look");
  expectNothing(findLook(look, image, Mask(), kMiddle, Eigen::Matrix2d::Zero()), "no area");
  GrayImage noise(120, 100);
  unsigned state = 1;
  for (std::uint8_t& value : noise.values) value = (state = state * 1664525u + 1013904223u) >> 24;
  expectNothing(findLook(look, noise, Mask(), kMiddle, same), "another tissue");
}

// Stripes do not tell how far they have moved along themselves.
TEST(FirstLook, IsNotFoundWhereItsPlaceIsUnsure) {
  GrayImage stripes(120, 100);
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 120; ++u)
      stripes.at(u, v) = static_cast<std::uint8_t>(std::lround(120 + 40 * std::sin(0.4 * u)));
  const FoundLook found = findLook(FirstLook::take(stripes, Mask(), kMiddle), stripes, Mask(),
                                   kMiddle, Eigen::Matrix2d::Identity());
  EXPECT_GT(found.correlation, 0.99);
  EXPECT_GT(found.sigma_px, 0.3);
  EXPECT_FALSE(found.found);
}

TEST(FirstLook, StaysInsideTheImage) {
  const GrayImage image = imageOf(kMiddle, Eigen::Matrix2d::Identity());
  EXPECT_EQ(FirstLook::take(image, Mask(), {1, 50}).taken, 0);
  EXPECT_EQ(FirstLook::take(image, Mask(), {8, 50}).taken, 1);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  for (const Eigen::Vector2d& outside :
       {Eigen::Vector2d(-30, 50), Eigen::Vector2d(119, 99), Eigen::Vector2d(1e30, 1e30)})
    EXPECT_FALSE(findLook(firstLook(), image, Mask(), outside, same).found);
}

}  // namespace
}  // namespace softscope
