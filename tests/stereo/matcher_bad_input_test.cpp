// tests/stereo/matcher_bad_input_test.cpp: pictures that no scope should send, but some do.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "stereo/matching/stereo_matcher.h"
#include "support/scene.h"

namespace softscope {
namespace {

std::size_t measuredPixels(const GrayImage& left, const GrayImage& right,
                           StereoOptions options = {}) {
  const DisparityMap map = makeStereoMatcher(options)->match(left, right);
  std::size_t measured = 0;
  for (const float d : map.disparity_px.values) measured += !std::isnan(d);
  return measured;
}

TEST(BadPictures, WithoutTextureYieldNothing) {
  for (const int gray : {0, 128, 255})
    EXPECT_EQ(measuredPixels(GrayImage(160, 120, static_cast<std::uint8_t>(gray)),
                             GrayImage(160, 120, static_cast<std::uint8_t>(gray))),
              0u);
}

TEST(BadPictures, OfPureNoiseYieldAlmostNothing) {
  std::mt19937 random(1);
  GrayImage left(320, 240), right(320, 240);
  for (auto& x : left.values) x = static_cast<std::uint8_t>(random());
  for (auto& x : right.values) x = static_cast<std::uint8_t>(random());
  EXPECT_LT(measuredPixels(left, right), 320u * 240u / 50);
}

TEST(BadPictures, WithOneBlackSideYieldNothing) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55));
  EXPECT_EQ(measuredPixels(scene.left, GrayImage(320, 240, 0)), 0u);
  EXPECT_EQ(measuredPixels(GrayImage(320, 240, 0), scene.right), 0u);
}

TEST(BadPictures, ExchangedLeftAndRightYieldLittle) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55));
  // Islands agree by chance; a seventh of the picture is far from the nine tenths of a right pair.
  EXPECT_LT(measuredPixels(scene.right, scene.left), 320u * 240u / 7);
}

TEST(BadPictures, OfUnequalOrTinySizeAreRefused) {
  const auto refuse = [](int w1, int h1, int w2, int h2) {
    EXPECT_THROW(measuredPixels(GrayImage(w1, h1, 9), GrayImage(w2, h2, 9)), InputError);
  };
  refuse(64, 64, 64, 65);
  refuse(0, 0, 0, 0);
  refuse(31, 64, 31, 64);
}

TEST(BadPictures, NarrowerThanTheRangeOfDisparitiesAreNoTrouble) {
  for (const int width : {32, 33, 47, 65, 100})
    for (const int height : {32, 49, 50}) {
      const auto scene = test::makeScene(test::endoscope(width, height), test::plane(55));
      StereoOptions options;
      options.disparity_max_px = 1023;
      EXPECT_NO_THROW(measuredPixels(scene.left, scene.right, options));
    }
}

TEST(BadPictures, WiderThanAnyScopeAreNoTrouble) {
  std::mt19937 random(1);
  GrayImage left(5000, 40), right(5000, 40);
  for (auto& x : left.values) x = static_cast<std::uint8_t>(50 + random() % 200);
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 5000 - 30; ++u) right.at(u, v) = left.at(u + 30, v);
  EXPECT_GT(measuredPixels(left, right), 5000u * 30u);
}

}  // namespace
}  // namespace softscope
