// tests/stereo/view_masks_test.cpp: what is masked or border is known before matching.
#include "stereo/images/view_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/mask_morphology.h"
#include "stereo/matching/stereo_matcher.h"
#include "stereo/rectification/image_border.h"
#include "stereo/rectification/row_alignment.h"
#include "support/scene.h"

namespace softscope {
namespace {

/// A frame of 20 px, its left side cut with a slant: the same pixels in both views.
Mask slantedFrame(int width, int height) {
  Mask mask(width, height, 0);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      mask.at(u, v) = u < 20 + v / 8 || u >= width - 20 || v < 20 || v >= height - 20;
  return mask;
}

void paint(const Mask& mask, std::uint8_t level, GrayImage& image) {
  for (std::size_t i = 0; i < image.size(); ++i)
    if (mask.values[i] != 0) image.values[i] = level;
}
void blacken(const Mask& mask, GrayImage& image) { paint(mask, 0, image); }

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

class FramedPair : public testing::TestWithParam<const char*> {
 protected:
  FramedPair() {
    blacken(frame_, scene_.left);
    blacken(frame_, scene_.right);
  }
  DisparityMap matched(const ViewMasks& ignored) const {
    StereoOptions options;
    options.method = GetParam();
    options.disparity_max_px = 63;
    return makeStereoMatcher(options)->match(scene_.left, scene_.right, ignored);
  }

  test::Scene scene_ = test::makeScene(test::endoscope(), test::plane(55, 0.3, 0.1), 2.0);
  Mask frame_ = slantedFrame(scene_.left.width_px, scene_.left.height_px);
};

TEST_P(FramedPair, HasNoDisparityInTheFrameAndARimAsGoodAsTheInside) {
  const DisparityMap found = matched({frame_, frame_});
  const Mask near_frame = dilated(frame_, 12);
  std::vector<double> rim_px, inside_px;
  int rim = 0;
  for (int v = 0; v < frame_.height_px; ++v)
    for (int u = 0; u < frame_.width_px; ++u) {
      const double error = std::abs(found.disparity_px.at(u, v) - scene_.disparity_px.at(u, v));
      if (frame_.at(u, v) != 0) {
        EXPECT_TRUE(std::isnan(error)) << u << ", " << v;
        EXPECT_TRUE(std::isnan(found.sigma_px.at(u, v))) << u << ", " << v;
        continue;
      }
      // The frame of the right camera hides pixels left of this.
      const bool is_rim = near_frame.at(u, v) != 0 && u > 100;
      rim += is_rim;
      if (std::isnan(error)) continue;
      (is_rim ? rim_px : inside_px).push_back(error);
    }
  EXPECT_GT(static_cast<double>(rim_px.size()), 0.6 * rim);  // 3 of 12 px are the window's reach
  EXPECT_LT(median(rim_px), 1.5 * median(inside_px));  // half of a window's pixels are missing
  EXPECT_LT(*std::max_element(rim_px.begin(), rim_px.end()), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Stereo, FramedPair, testing::Values("elas", "sgbm"),
                         [](const auto& param) { return std::string(param.param); });

/// Share of what was measured within 25 px of the left cut that is more than 10 % off, by more than
/// so many standard errors.
double wrongNearCut(const DisparityMap& found, const Raster<float>& truth_px, const Mask& frame,
                    float sigmas = 0) {
  const Mask near_cut = dilated(frame, 25);
  double measured = 0, wrong = 0;
  for (int v = 45; v < frame.height_px - 45; ++v)
    for (int u = 0; u < 160; ++u) {
      const float d = found.disparity_px.at(u, v), truth = truth_px.at(u, v);
      if (near_cut.at(u, v) == 0 || std::isnan(d)) continue;
      ++measured;
      wrong += std::abs(d - truth) > std::max(0.1f * truth, sigmas * found.sigma_px.at(u, v));
    }
  EXPECT_GT(measured, 500);
  return wrong / measured;
}

TEST(ElasMatcher, DoesNotTakeTheCutOfAFrameForTissue) {
  // Weak texture, and a frame whose left cut has 1.4 times the disparity of the tissue.
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 15.0);  // 25.5 px
  for (GrayImage* image : {&scene.left, &scene.right})
    for (std::uint8_t& gray : image->values)
      gray = static_cast<std::uint8_t>(std::lround(90 + 0.1 * (gray - 90)));
  ViewMasks frame{Mask(320, 240, 0), Mask(320, 240, 0)};
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) {
      frame.left.at(u, v) = u < 70 + v / 8 || u >= 300 || v < 20 || v >= 220;
      frame.right.at(u, v) = u < 34 + v / 8 || u >= 300 || v < 20 || v >= 220;
    }
  blacken(frame.left, scene.left);
  blacken(frame.right, scene.right);
  const auto matcher = makeStereoMatcher({});
  const DisparityMap unaware = matcher->match(scene.left, scene.right);
  const DisparityMap aware = matcher->match(scene.left, scene.right, frame);
  EXPECT_GT(wrongNearCut(unaware, scene.disparity_px, frame.left), 0.1);  // the trap is one
  EXPECT_LT(wrongNearCut(aware, scene.disparity_px, frame.left), 0.01);
  // It is the rim of a near surface: who is not aware of it doubts it at least.
  EXPECT_LT(wrongNearCut(unaware, scene.disparity_px, frame.left, 4), 0.05);
}

TEST(FramedRows, AreMeasuredInTheTissueAlone) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  RowAlignment inverse;
  inverse.half_width_px = 160;
  inverse.centre_u_px = 159.5;
  inverse.model[0] = -1.6;
  scene.right = toGray(removeRowError(test::colourOf(scene.right), inverse));
  const Mask frame = slantedFrame(320, 240);
  blacken(frame, scene.left);
  blacken(frame, scene.right);
  const RowAlignment found = measureRowAlignment(scene.left, scene.right, 100, {frame, frame});
  ASSERT_TRUE(found.known());
  EXPECT_NEAR(found.at(160, 120), 1.6, 0.15);  // half of the image, so half of the matches
  EXPECT_LT(found.residual_px, 0.15);
}

TEST(AlignRows, MovesTheRightMaskWithItsView) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  RowAlignment inverse;
  inverse.half_width_px = 160;
  inverse.model[0] = -3;
  scene.right = toGray(removeRowError(test::colourOf(scene.right), inverse));
  Mask frame(320, 240, 0);
  std::fill(frame.row(220), frame.row(220) + 320, std::uint8_t{1});
  const AlignedPair aligned =
      alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100, {{}, frame});
  ASSERT_TRUE(aligned.removed);
  EXPECT_NE(aligned.ignored.right.at(160, 217), 0);  // row v shows what was at v + 3
  EXPECT_EQ(aligned.ignored.right.at(160, 223), 0);
}

TEST(FillMasked, ContinuesTheImageWithoutAnEdge) {
  GrayImage image(64, 48, 120);
  const Mask mask = slantedFrame(64, 48);
  blacken(mask, image);
  for (const std::uint8_t value : fillMasked(image, mask).values) EXPECT_EQ(value, 120);
  EXPECT_EQ(fillMasked(image, {}).values, image.values);
  const Mask everything(64, 48, 1);
  EXPECT_EQ(fillMasked(image, everything).values, image.values);
}

TEST(FillMasked, LeavesUnmaskedPixelsAsTheyAre) {
  const auto scene = test::makeScene(test::endoscope(160, 120), test::plane(55), 2.0);
  const Mask mask = slantedFrame(160, 120);
  const GrayImage filled = fillMasked(scene.left, mask);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.values[i] != 0) continue;
    EXPECT_EQ(filled.values[i], scene.left.values[i]);
  }
}

TEST(HalvedMask, KeepsEveryMaskedPixel) {
  Mask mask(9, 6, 0);
  mask.at(3, 4) = 7;
  const Mask half = halvedMask(mask);
  ASSERT_EQ(half.width_px, 4);
  ASSERT_EQ(half.height_px, 3);
  for (int v = 0; v < 3; ++v)
    for (int u = 0; u < 4; ++u) EXPECT_EQ(half.at(u, v) != 0, u == 1 && v == 2);
}

TEST(Border, IsFoundWithItsCutAndNothingElse) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 2.0);
  const Mask frame = slantedFrame(320, 240);
  blacken(frame, scene.left);
  for (int v = 100; v < 120; ++v)  // a dark hole in the tissue is no border
    for (int u = 150; u < 180; ++u) scene.left.at(u, v) = 0;
  const Mask found = findBorder(test::colourOf(scene.left));
  ASSERT_TRUE(found.sameShape(frame));
  for (std::size_t i = 0; i < frame.size(); ++i)
    EXPECT_EQ(found.values[i] != 0, frame.values[i] != 0) << i % 320 << ", " << i / 320;
}

TEST(Border, IsFoundOnAnySideFromSixPixelsOn) {
  constexpr int kImageWidth = 96, kImageHeight = 64;
  const auto blackened = [&](int u0, int v0, int u1, int v1) {
    ColourImage image = test::colourOf(GrayImage(kImageWidth, kImageHeight, 90));
    for (int v = v0; v < v1; ++v)
      for (int u = u0; u < u1; ++u) image.at(u, v) = {};
    return image;
  };
  for (const int deep : {5, 6, 7}) {
    const bool found = deep >= 6;  // half a square and its centre
    EXPECT_EQ(findBorder(blackened(0, 0, kImageWidth, deep)).empty(), !found);
    EXPECT_EQ(findBorder(blackened(0, kImageHeight - deep, kImageWidth, kImageHeight)).empty(),
              !found);
    EXPECT_EQ(findBorder(blackened(0, 0, deep, kImageHeight)).empty(), !found);
    EXPECT_EQ(findBorder(blackened(kImageWidth - deep, 0, kImageWidth, kImageHeight)).empty(),
              !found);
  }
  for (const int wide : {10, 11}) {  // a square at the edge; in a corner half of it is enough
    const bool found = wide >= 11;
    EXPECT_EQ(findBorder(blackened(40, 0, 40 + wide, 8)).empty(), !found);
    EXPECT_EQ(findBorder(blackened(0, 30, 8, 30 + wide)).empty(), !found);
  }
  EXPECT_FALSE(findBorder(blackened(0, 0, 6, 6)).empty());
  EXPECT_FALSE(
      findBorder(blackened(kImageWidth - 6, kImageHeight - 6, kImageWidth, kImageHeight)).empty());
  EXPECT_TRUE(findBorder(blackened(40, 30, 60, 50)).empty());  // a hole in the tissue
}

TEST(Border, MayBeGreyButNotNoisyOrBright) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55), 2.0);
  const Mask frame = slantedFrame(320, 240);
  for (const std::uint8_t level : {16, 40, 100}) {
    GrayImage framed = scene.left;
    paint(frame, level, framed);
    const Mask found = findBorder(test::colourOf(framed));
    ASSERT_TRUE(found.sameShape(frame)) << int(level);
    const Mask reach = dilated(frame, 14);  // tissue of this level beside it is taken for border
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (frame.values[i] != 0) EXPECT_NE(found.values[i], 0);
      if (reach.values[i] == 0) EXPECT_EQ(found.values[i], 0);
    }
  }
  GrayImage bright = scene.left, noisy = scene.left;
  paint(frame, 255, bright);
  EXPECT_TRUE(findBorder(test::colourOf(bright)).empty());
  paint(frame, 40, noisy);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.values[i] != 0) noisy.values[i] += static_cast<std::uint8_t>(random() % 4);
  EXPECT_TRUE(findBorder(test::colourOf(noisy)).empty());
}

TEST(Border, MayBeGreyWithinTheBlackOfRectification) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55), 2.0);
  const Mask frame = slantedFrame(320, 240);
  paint(frame, 30, scene.left);
  Mask outside(320, 240, 0);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) outside.at(u, v) = u < 7 || u >= 313 || v < 7 || v >= 233;
  blacken(outside, scene.left);
  const Mask found = findBorder(test::colourOf(scene.left));
  ASSERT_TRUE(found.sameShape(frame));
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.values[i] != 0) EXPECT_NE(found.values[i], 0) << i % 320 << ", " << i / 320;
  EXPECT_EQ(found.at(160, 120), 0);
}

TEST(Border, IsNotTheDarkBackgroundOfAnOrgan) {
  // A ball in front of nothing; the background has the noise of the sensor, too.
  const auto scene = test::makeScene(test::endoscope(), test::sphere({0, 0, 60}, 18), 3.0);
  EXPECT_TRUE(findBorder(test::colourOf(scene.left)).empty());
}

TEST(Border, IsNotAnImageThatIsBlackAltogether) {
  EXPECT_TRUE(findBorder(ColourImage(64, 48)).empty());
  EXPECT_TRUE(findBorder(test::colourOf(GrayImage(64, 48, 90))).empty());
}

}  // namespace
}  // namespace softscope
