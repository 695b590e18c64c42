// tests/eval/map_errors_test.cpp: disparity and depth maps with errors that were put in.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "eval/images/depth_errors.h"
#include "eval/images/disparity_errors.h"
#include "eval/images/pixel_masks.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kExact = 1e-9;  // eighths and halves are exact in float, percentages nearly

/// 10 x 4: rows of truth 2, so that u = 0 and u = 1 have no match; the last pixel is unknown.
Raster<float> truthOfTwo() {
  Raster<float> truth_px(10, 4, 2.0f);
  truth_px.at(9, 3) = kNaN;
  return truth_px;
}

TEST(DisparityErrors, MeasureAShiftExactly) {
  const DisparityErrors e = disparityErrors(Raster<float>(10, 4, 2.25f), truthOfTwo());
  EXPECT_EQ(e.absolute_px.count, 39u);
  EXPECT_NEAR(e.absolute_px.median, 0.25, kExact);
  EXPECT_NEAR(e.absolute_px.mean, 0.25, kExact);
  EXPECT_NEAR(e.absolute_px.rmse, 0.25, kExact);
  EXPECT_NEAR(e.signed_px.mean, 0.25, kExact);
  EXPECT_NEAR(e.signed_px.sd, 0, kExact);
  EXPECT_EQ(e.matchable_count, 31u);  // 8 columns of 4 rows, less the unknown one
  EXPECT_EQ(e.coverage_percent, 100);
}

TEST(DisparityErrors, CountBadPixelsOverTheMeasuredOnes) {
  Raster<float> measured_px(10, 4, kNaN);
  for (int u = 2; u < 10; ++u) measured_px.at(u, 0) = 2;  // right
  measured_px.at(2, 0) = 5;                               // wrong by 3: not above 3
  measured_px.at(3, 0) = -1.5f;                           // wrong by 3.5
  const DisparityErrors e = disparityErrors(measured_px, truthOfTwo());
  EXPECT_EQ(e.absolute_px.count, 8u);
  ASSERT_EQ(e.bad_percent.size(), 3u);
  EXPECT_NEAR(e.bad_percent[0], 25, kExact);
  EXPECT_NEAR(e.bad_percent[2], 12.5, kExact);
  EXPECT_NEAR(e.coverage_percent, 100.0 * 8 / 31, kExact);
}

TEST(DisparityErrors, LeaveMaskedPixelsOutOfEverything) {
  Raster<float> measured_px(10, 4, 2.0f);
  Mask ignore(10, 4);
  for (int v = 0; v < 4; ++v)
    for (int u = 4; u < 10; ++u) {
      measured_px.at(u, v) = 50;
      ignore.at(u, v) = 255;
    }
  const DisparityErrors e = disparityErrors(measured_px, truthOfTwo(), {}, ignore);
  EXPECT_EQ(e.absolute_px.count, 16u);
  EXPECT_EQ(e.absolute_px.max, 0);
  EXPECT_EQ(e.matchable_count, 8u);
}

TEST(DisparityErrors, CompareTwoMethodsWhereBothMeasured) {
  Raster<float> first(10, 4, 2.5f), second(10, 4, 2.0f);
  first.at(5, 1) = kNaN;
  second.at(6, 1) = kNaN;
  const Mask both = ignoreEither(ignoreUnmeasured(first), ignoreUnmeasured(second));
  EXPECT_EQ(disparityErrors(first, truthOfTwo(), {}, both).absolute_px.count, 37u);
  EXPECT_EQ(disparityErrors(second, truthOfTwo(), {}, both).absolute_px.count, 37u);
}

TEST(DisparityErrors, OfNothingMeasuredAreNaN) {
  const DisparityErrors e = disparityErrors(Raster<float>(10, 4, kNaN), truthOfTwo());
  EXPECT_TRUE(std::isnan(e.absolute_px.median));
  EXPECT_TRUE(std::isnan(e.bad_percent[0]));
  EXPECT_EQ(e.coverage_percent, 0);
  const DisparityErrors unknown =
      disparityErrors(Raster<float>(10, 4, 1), Raster<float>(10, 4, kNaN));
  EXPECT_TRUE(std::isnan(unknown.coverage_percent));
}

TEST(DisparityErrors, RefuseMapsOfTwoSizes) {
  EXPECT_THROW(disparityErrors(Raster<float>(10, 3), truthOfTwo()), InputError);
  EXPECT_THROW(disparityErrors(truthOfTwo(), truthOfTwo(), {}, Mask(4, 10)), InputError);
  EXPECT_THROW(ignoreEither(Mask(4, 10), Mask(10, 4)), InputError);
  DisparityErrorOptions options;
  options.bad_thresholds_px = {-1};
  EXPECT_THROW(disparityErrors(truthOfTwo(), truthOfTwo(), options), OptionError);
}

TEST(DepthErrors, MeasureAPlaneThatIsTooFar) {
  Raster<float> truth_mm(8, 8, 55.0f), measured_mm(8, 8, 56.5f);
  truth_mm.at(0, 0) = kNaN;
  measured_mm.at(1, 0) = kNaN;
  const DepthErrors e = depthErrors(measured_mm, truth_mm);
  EXPECT_EQ(e.absolute_mm.count, 62u);
  EXPECT_NEAR(e.signed_mm.mean, 1.5, kExact);
  EXPECT_NEAR(e.absolute_mm.rmse, 1.5, kExact);
  EXPECT_EQ(e.bad_percent[0], 100);
  EXPECT_EQ(e.bad_percent[1], 0);
  EXPECT_EQ(e.known_count, 63u);
  EXPECT_NEAR(e.coverage_percent, 100.0 * 62 / 63, kExact);
  EXPECT_THROW(depthErrors(measured_mm, Raster<float>(4, 4)), InputError);
}

TEST(DepthErrors, JudgeWhatBothCamerasSee) {
  RectifiedRig rig;
  rig.left = {10, 4, 100, 100, 4.5, 1.5};
  rig.baseline_mm = 5;
  const Raster<float> truth_mm(10, 4, 250);  // 2 px
  EXPECT_NEAR(disparityFromDepth(truth_mm, rig).at(3, 2), 2, 1e-6);
  const Mask outside = ignoreMatchesOutside(disparityFromDepth(truth_mm, rig));
  EXPECT_EQ(depthErrors(truth_mm, truth_mm, {}, outside).known_count, 32u);
  const Raster<float> hole = disparityFromDepth(Raster<float>(1, 1, 0.0f), rig);
  EXPECT_TRUE(std::isnan(hole.values[0]));  // no depth, not "infinitely near"
}

}  // namespace
}  // namespace softscope
