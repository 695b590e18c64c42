// tests/eval/picture_errors_test.cpp: pictures whose likeness has a closed form.
#include "eval/images/picture_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

ColourImage flat(std::uint8_t value, int width = 32, int height = 24) {
  return ColourImage(width, height, Rgb8{value, value, value});
}

TEST(PictureErrors, OneDifferenceEverywhereHasAClosedForm) {
  const PictureErrors errors = pictureErrors(flat(110), flat(100));
  EXPECT_NEAR(errors.psnr_db, 20 * std::log10(255.0 / 10), 1e-9);
  EXPECT_NEAR(errors.psnr_over_all_pixels_db, errors.psnr_db, 1e-12);
  // Without variance only the luminance term is left.
  const double c1 = 6.5025;
  EXPECT_NEAR(errors.ssim, (2 * 110 * 100 + c1) / (110 * 110 + 100 * 100 + c1), 1e-9);
  EXPECT_EQ(errors.judged_share, 1);
}

TEST(PictureErrors, OnePictureIsLikeItself) {
  ColourImage picture = flat(0);
  for (int v = 0; v < 24; ++v)
    for (int u = 0; u < 32; ++u) picture.at(u, v) = {std::uint8_t(7 * u), std::uint8_t(9 * v), 3};
  const PictureErrors errors = pictureErrors(picture, picture);
  EXPECT_TRUE(std::isinf(errors.psnr_db) && errors.psnr_db > 0);
  EXPECT_NEAR(errors.ssim, 1, 1e-12);
}

TEST(PictureErrors, OppositePatternsAreUnlike) {
  ColourImage a = flat(0), b = flat(0);
  for (int v = 0; v < 24; ++v)
    for (int u = 0; u < 32; ++u) {
      const std::uint8_t value = (u + v) % 2 == 0 ? 255 : 0;
      a.at(u, v) = {value, value, value};
      b.at(u, v) = {std::uint8_t(255 - value), std::uint8_t(255 - value),
                    std::uint8_t(255 - value)};
    }
  EXPECT_LT(pictureErrors(a, b).ssim, -0.9);
}

TEST(PictureErrors, IgnoredPixelsCountInNothingButTheSecondFigure) {
  ColourImage drawn = flat(100);
  Mask ignore(32, 24, 0);
  for (int v = 0; v < 24; ++v)
    for (int u = 0; u < 8; ++u) {
      drawn.at(u, v) = {0, 0, 0};
      ignore.at(u, v) = 1;
    }
  const PictureErrors errors = pictureErrors(drawn, flat(110), ignore);
  EXPECT_NEAR(errors.psnr_db, 20 * std::log10(255.0 / 10), 1e-9);
  EXPECT_NEAR(errors.psnr_over_all_pixels_db, errors.psnr_db + 10 * std::log10(4.0 / 3), 1e-9)
      << "the inflated one";
  EXPECT_EQ(errors.judged_share, 0.75);
  EXPECT_NEAR(errors.ssim, pictureErrors(flat(100), flat(110)).ssim, 1e-9)
      << "no window may reach into the ignored part";
}

TEST(PictureErrors, TheShareIsOfTheTissue) {
  Mask undrawn(32, 24, 0), border(32, 24, 0);
  for (int v = 0; v < 24; ++v)
    for (int u = 0; u < 16; ++u) {
      if (u < 8) border.at(u, v) = 1;  // a quarter of the picture
      undrawn.at(u, v) = 1;            // the border and as much tissue
    }
  EXPECT_NEAR(pictureErrors(flat(100), flat(110), undrawn, border).judged_share, 2.0 / 3, 1e-12);
}

TEST(PictureErrors, NothingJudgedIsNoNumber) {
  const PictureErrors errors = pictureErrors(flat(1), flat(2), Mask(32, 24, 255));
  EXPECT_TRUE(std::isnan(errors.psnr_db));
  EXPECT_TRUE(std::isnan(errors.ssim));
  EXPECT_EQ(errors.judged_share, 0);
  EXPECT_TRUE(std::isnan(pictureErrors(flat(1, 8, 8), flat(1, 8, 8)).ssim)) << "no whole window";
}

TEST(PictureErrors, SizesMustAgree) {
  EXPECT_THROW(pictureErrors(flat(1), flat(1, 24, 32)), InputError);
  EXPECT_THROW(pictureErrors(flat(1), flat(1), Mask(2, 2, 0)), InputError);
}

}  // namespace
}  // namespace softscope
