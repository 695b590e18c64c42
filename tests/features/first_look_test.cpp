// tests/features/first_look_test.cpp: a window of the first image is found again.
#include "features/first_look.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

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

FirstLook takeLook(const GrayImage& image, const Eigen::Vector2d& pixel = kMiddle) {
  return FirstLook::take(LookPicture(image, Mask()), pixel);
}

FirstLook firstLook() { return takeLook(imageOf(kMiddle, Eigen::Matrix2d::Identity())); }

FoundLook find(const FirstLook& look, const GrayImage& image, const Mask& ignore,
               const Eigen::Vector2d& pixel, const Eigen::Matrix2d& map) {
  return findLook({&look, 0, pixel, map}, LookPicture(image, ignore));
}

TEST(FirstLook, IsFoundWhereItIsToATwentiethOfAPixel) {
  Eigen::Matrix2d map;
  map << 1.1, 0.05, -0.08, 0.95;
  const Eigen::Vector2d at(63.3, 48.6);
  const GrayImage image = imageOf(at, map);
  const FoundLook found = find(firstLook(), image, Mask(), at + Eigen::Vector2d(1.4, -1.1), map);
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
      find(firstLook(), imageOf(at, map), Mask(), kMiddle, Eigen::Matrix2d::Identity());
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.pixel - at).norm(), 0.05);
}

TEST(FirstLook, IsFoundUnderOtherLight) {
  const Eigen::Vector2d at(60.8, 49.5);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  const FoundLook found = find(firstLook(), imageOf(at, same, 0.6, 30), Mask(), kMiddle, same);
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
  const FoundLook found = find(firstLook(), image, mask, kMiddle, same);
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
  expectNothing(find(look, GrayImage(120, 100, 90), Mask(), kMiddle, same), "no texture");
  expectNothing(find(look, image, Mask(120, 100, 1), kMiddle, same), "all masked");
  expectNothing(find(FirstLook(), image, Mask(), kMiddle, same), "no look");
  expectNothing(find(look, image, Mask(), kMiddle, Eigen::Matrix2d::Zero()), "no area");
  GrayImage noise(120, 100);
  unsigned state = 1;
  for (std::uint8_t& value : noise.values) value = (state = state * 1664525u + 1013904223u) >> 24;
  expectNothing(find(look, noise, Mask(), kMiddle, same), "another tissue");
}

// Stripes do not show motion along themselves.
TEST(FirstLook, IsNotFoundWhereItsPlaceIsUnsure) {
  GrayImage stripes(120, 100);
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 120; ++u)
      stripes.at(u, v) = static_cast<std::uint8_t>(std::lround(120 + 40 * std::sin(0.4 * u)));
  const FoundLook found =
      find(takeLook(stripes), stripes, Mask(), kMiddle, Eigen::Matrix2d::Identity());
  EXPECT_GT(found.correlation, 0.99);
  EXPECT_GT(found.sigma_px, 0.3);
  EXPECT_FALSE(found.found);
}

const Eigen::Vector2d kBlob(80, 80);

/// Blobs of `width_px` (standard deviation), nowhere alike, moved by `shift`; of contrast 1.
Raster<double> blobs(const Eigen::Vector2d& shift, double width_px) {
  std::mt19937 places(7);
  std::uniform_real_distribution<double> across(-20, 180);
  std::normal_distribution<double> deviate(0, 1);
  Raster<double> brightness(160, 160, 0.0);
  for (int k = 0; k < 5500 / (width_px * width_px); ++k) {
    const double x = across(places) + shift.x(), y = across(places) + shift.y();
    const double height = deviate(places);
    for (int v = std::max(0, static_cast<int>(y) - 30); v < std::min(160.0, y + 30); ++v)
      for (int u = std::max(0, static_cast<int>(x) - 30); u < std::min(160.0, x + 30); ++u)
        brightness.at(u, v) +=
            height * std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * width_px * width_px));
  }
  return brightness;
}

GrayImage photograph(const Raster<double>& brightness, double contrast_gray, double noise_gray,
                     unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> deviate(0, 1);
  GrayImage image(brightness.width_px, brightness.height_px);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const double gray = 120 + contrast_gray * brightness.values[i] + noise_gray * deviate(random);
    image.values[i] = static_cast<std::uint8_t>(std::lround(std::clamp(gray, 0.0, 255.0)));
  }
  return image;
}

TEST(FirstLook, IsFoundFromATenthOfTheImageAway) {
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d shift(9.3, -6.8);
  const FirstLook look = takeLook(photograph(blobs({0, 0}, 5), 20, 0, 1), kBlob);
  const FoundLook found = find(look, photograph(blobs(shift, 5), 20, 0, 1), Mask(), kBlob, same);
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.pixel - kBlob - shift).norm(), 0.05);
  EXPECT_FALSE(find(look, photograph(blobs({30, 0}, 5), 20, 0, 1), Mask(), kBlob, same).found);
}

/// A bright surface with faint blobs before a dark one, whose contour is `edge_px` right of kBlob;
/// the blobs have moved by `shift`.
GrayImage beforeDark(const Eigen::Vector2d& shift, double edge_px) {
  GrayImage image = photograph(blobs(shift, 2.5), 8, 0.5, 1);
  for (int v = 0; v < image.height_px; ++v)
    for (int u = static_cast<int>(kBlob.x() + edge_px); u < image.width_px; ++u)
      image.at(u, v) = 20;
  return image;
}

// A contour moves over the tissue with the scope: here by 3 px, where the tissue moves by 0.5.
TEST(FirstLook, FollowsTheTissueAndNotItsContour) {
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d shift(0.5, 0);
  const LookPicture first(beforeDark({0, 0}, 7), Mask()), now(beforeDark(shift, 10), Mask());
  DepthMap depth{Raster<float>(160, 160, 60.0F), {}};
  for (int v = 0; v < 160; ++v)
    for (int u = static_cast<int>(kBlob.x()) + 7; u < 160; ++u) depth.depth_mm.at(u, v) = 80;
  const ConnectedSurface surface(depth, kBlob, 300, FirstLook::kReachPx);
  const FirstLook of_surface = FirstLook::take(first, kBlob, &surface);
  const FoundLook followed = findLook({&of_surface, 0, kBlob, same}, now);
  ASSERT_TRUE(followed.found);
  EXPECT_LT((followed.pixel - kBlob - shift).norm(), 0.2);
  const FirstLook of_window = FirstLook::take(first, kBlob);
  const FoundLook misled = findLook({&of_window, 0, kBlob, same}, now);
  EXPECT_GT((misled.pixel - kBlob - shift).norm(), 1);
}

// Much tissue rarely moves as one: a quarter-size window counts only if the half-size one, though
// too noisy to be found, is at the same place.
TEST(FirstLook, IsNotFoundWhereTheHalfContradictsTheQuarter) {
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  const GrayImage image = photograph(blobs({0, 0}, 5), 20, 0, 1);
  const auto findWithFiner = [&](const GrayImage& finer) {
    FirstLook look = takeLook(image, kBlob);
    const FirstLook other = takeLook(finer, kBlob);
    for (std::size_t level : {0, 1}) look.windows[level] = other.windows[level];
    return find(look, image, Mask(), kBlob, same);
  };
  const FoundLook noisy = findWithFiner(photograph(blobs({0, 0}, 5), 20, 40, 1));
  ASSERT_TRUE(noisy.found);
  EXPECT_LT((noisy.pixel - kBlob).norm(), 0.3);
  EXPECT_FALSE(findWithFiner(photograph(blobs({30, 17}, 5), 20, 0, 1)).found);
}

/// Root mean square of its errors over what it predicted, under noise of both images.
double errorOverSigma(double contrast_gray, double noise_gray) {
  constexpr unsigned kTrials = 40;
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  double squares = 0;
  int found = 0;
  for (const Eigen::Vector2d& shift : {Eigen::Vector2d(0.25, -0.3), {0.6, 0.4}}) {
    const Raster<double> first = blobs({0, 0}, 2.5), now = blobs(shift, 2.5);
    for (unsigned seed = 0; seed < kTrials; ++seed) {
      const FoundLook at =
          find(takeLook(photograph(first, contrast_gray, noise_gray, 2 * seed), kBlob),
               photograph(now, contrast_gray, noise_gray, 2 * seed + 1), Mask(), kBlob, same);
      if (!at.found) continue;
      ++found;
      squares += (at.pixel - kBlob - shift).squaredNorm() / (2 * at.sigma_px * at.sigma_px);
    }
  }
  EXPECT_GE(found, 70) << contrast_gray << ", " << noise_gray;
  return std::sqrt(squares / found);
}

// Noise passes neither for texture nor for certainty. sigma_px is that of the worse direction.
TEST(FirstLook, PredictsItsErrorUnderNoise) {
  for (const auto& [contrast_gray, noise_gray] :
       {std::pair(20.0, 1.0), {20.0, 4.0}, {8.0, 4.0}, {5.0, 5.0}}) {
    const double ratio = errorOverSigma(contrast_gray, noise_gray);
    std::printf("contrast %2.0f, noise %1.0f gray levels: errors are %.2f sigma\n", contrast_gray,
                noise_gray, ratio);
    EXPECT_GT(ratio, 0.6) << contrast_gray << ", " << noise_gray;
    EXPECT_LT(ratio, 1.25) << contrast_gray << ", " << noise_gray;
  }
}

TEST(FirstLook, StaysInsideTheImage) {
  const GrayImage image = imageOf(kMiddle, Eigen::Matrix2d::Identity());
  EXPECT_EQ(takeLook(image, {1, 50}).windows[0].taken, 0);
  EXPECT_EQ(takeLook(image, {8, 50}).windows[0].taken, 1);
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  for (const Eigen::Vector2d& outside :
       {Eigen::Vector2d(-30, 50), Eigen::Vector2d(119, 99), Eigen::Vector2d(1e30, 1e30)})
    EXPECT_FALSE(find(firstLook(), image, Mask(), outside, same).found);
}

}  // namespace
}  // namespace softscope
