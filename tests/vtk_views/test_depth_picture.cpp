// tests/vtk_views/test_depth_picture.cpp: the figure says what was measured, in the bar's colours.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/plots/depth_picture.h"

namespace softscope {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Left third 40 mm, middle 60 mm, right third not measured.
Raster<float> threeStripes() {
  Raster<float> depth_mm(kWidth, kHeight, kNan);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < 2 * kWidth / 3; ++u) depth_mm.at(u, v) = u < kWidth / 3 ? 40.f : 60.f;
  return depth_mm;
}

struct Drawn {
  DepthPictureLayout layout = layoutDepthPicture(kWidth, kHeight);
  ColourImage figure;

  Drawn(const Raster<float>& depth_mm, const Mask& mask, const DepthRange& range)
      : figure(drawDepthPicture(ColourImage(kWidth, kHeight, {180, 60, 50}), depth_mm, mask, range,
                                {"title", "note"})) {}
  Rgb8 at(const Box& box, double across, double down) const {
    return figure.at(box.x_px + int(across * box.width_px), box.y_px + int(down * box.height_px));
  }
};

TEST(DepthPicture, ShowsKnownDepthsInTheirColours) {
  const Drawn drawn(threeStripes(), {}, {30, 70});
  EXPECT_EQ(drawn.figure.width_px, drawn.layout.width_px);
  EXPECT_EQ(drawn.at(drawn.layout.depth, 0.16, 0.5), viridis(0.25));  // 40 of 30…70
  EXPECT_EQ(drawn.at(drawn.layout.depth, 0.5, 0.5), viridis(0.75));
  EXPECT_EQ(drawn.at(drawn.layout.depth, 0.9, 0.5), kUnmeasuredGrey);
  EXPECT_EQ(drawn.at(drawn.layout.photograph, 0.5, 0.5), (Rgb8{180, 60, 50}));
}

TEST(DepthPicture, TheBarRunsFromNearestBelowToFarthestAbove) {
  const Drawn drawn(threeStripes(), {}, {30, 70});
  EXPECT_EQ(drawn.at(drawn.layout.bar, 0.5, 0.0), viridis(1 - 0.5 / kHeight));
  EXPECT_EQ(drawn.at(drawn.layout.bar, 0.5, 0.999), viridis(0.5 / kHeight));
}

TEST(DepthPicture, TicksAndTextStandRightOfTheBar) {
  const Drawn drawn(threeStripes(), {}, {30, 70});
  int dark = 0;
  for (int v = drawn.layout.bar.y_px; v < drawn.layout.bar.bottom_px(); ++v)
    for (int u = drawn.layout.bar.right_px() + 2; u < drawn.layout.width_px; ++u)
      dark += drawn.figure.at(u, v).green < 128;
  EXPECT_GT(dark, 300);  // five numbers and "depth [mm]" at this size cover about 900 pixels
  for (int v = 0; v < drawn.layout.height_px; ++v)
    EXPECT_EQ(drawn.figure.at(drawn.layout.width_px - 1, v), (Rgb8{255, 255, 255})) << "text cut";
}

TEST(DepthPicture, ArrowsAppearOnlyWhereDepthsLeaveTheBar) {
  const auto above = [](const Drawn& drawn) {
    const Box& bar = drawn.layout.bar;
    return drawn.figure.at(bar.x_px + bar.width_px / 2, bar.y_px - 5);
  };
  EXPECT_EQ(above(Drawn(threeStripes(), {}, {30, 70})), (Rgb8{255, 255, 255}));
  EXPECT_EQ(above(Drawn(threeStripes(), {}, {30, 50})), viridis(1));
}

TEST(DepthPicture, MaskedPixelsAreGreyEvenWhereDepthIsKnown) {
  const Drawn drawn(threeStripes(), Mask(kWidth, kHeight, 1), {30, 70});
  EXPECT_EQ(drawn.at(drawn.layout.depth, 0.16, 0.5), kMaskedGrey);
}

TEST(DepthPicture, TheRangeIsRoundAndHoldsTheMiddleOfTheData) {
  Raster<float> depth_mm(100, 10, kNan);
  for (int i = 0; i < 1000; ++i) depth_mm.values[std::size_t(i)] = 47.3f + 0.02f * float(i);
  depth_mm.values[0] = 900;  // one outlier must not flatten the rest
  const DepthRange range = depthRangeToShow(depth_mm);
  EXPECT_LE(range.nearest_mm, 47.5);
  EXPECT_GE(range.nearest_mm, 45);
  EXPECT_GE(range.farthest_mm, 67);
  EXPECT_LE(range.farthest_mm, 70);
  EXPECT_DOUBLE_EQ(range.nearest_mm, std::round(range.nearest_mm));
}

TEST(DepthPicture, AFlatOrEmptyFrameStillHasARange) {
  const DepthRange flat = depthRangeToShow(Raster<float>(4, 4, 50.f));
  EXPECT_LT(flat.nearest_mm, 50);
  EXPECT_GT(flat.farthest_mm, 50);
  const DepthRange none = depthRangeToShow(Raster<float>(4, 4, kNan));
  EXPECT_LT(none.nearest_mm, none.farthest_mm);
}

TEST(DepthPicture, RefusesRastersOfDifferentShape) {
  EXPECT_THROW(drawDepthPicture(ColourImage(4, 4), Raster<float>(5, 4), {}, {0, 1}, {}), Error);
}

}  // namespace
}  // namespace softscope
