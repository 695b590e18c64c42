// tests/features/masks_test.cpp: highlights and instruments are found, tissue is left alone.
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "features/highlight_mask.h"
#include "features/instrument_detector.h"

namespace softscope {
namespace {

constexpr Rgb8 kTissue{180, 90, 70}, kFat{230, 200, 150}, kSteel{120, 130, 150};

void paint(ColourImage* image, int u0, int v0, int u1, int v1, Rgb8 colour) {
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) image->at(u, v) = colour;
}

int marked(const Mask& mask) { return std::accumulate(mask.values.begin(), mask.values.end(), 0); }

TEST(HighlightMask, MarksWhiteWithItsHaloAndNothingElse) {
  ColourImage image(100, 80, kTissue);
  paint(&image, 10, 10, 30, 30, kFat);
  paint(&image, 60, 40, 64, 44, {255, 252, 246});
  paint(&image, 80, 40, 84, 44, {255, 120, 90});  // saturated red is no highlight
  const Mask mask = highlightMask(image);
  EXPECT_EQ(marked(mask), 10 * 10);  // 4 px and 3 px of halo on both sides
  EXPECT_EQ(mask.at(57, 37), 1);
  EXPECT_EQ(mask.at(56, 37), 0);
  EXPECT_TRUE(highlightMask({}).empty());
}

TEST(InstrumentDetector, MarksAShaftFromTheBorderAndNotAGreySpot) {
  ColourImage image(320, 240, kTissue);
  paint(&image, 0, 100, 120, 140, kSteel);  // a shaft
  paint(&image, 200, 60, 230, 90, kSteel);  // grey-blue tissue in the middle
  paint(&image, 300, 0, 320, 200, kFat);
  const Mask mask = detectInstruments(image);
  for (int v = 100; v < 140; ++v)
    for (int u = 0; u < 120; ++u) ASSERT_EQ(mask.at(u, v), 1) << u << ", " << v;
  EXPECT_EQ(mask.at(215, 75), 0);
  EXPECT_EQ(mask.at(310, 100), 0);
  EXPECT_LE(marked(mask), 132 * 64);  // the shaft, its rim of 10 px, and the filter's reach
}

TEST(InstrumentDetector, TissueAloneBlackAndNothingGiveNone) {
  EXPECT_EQ(marked(detectInstruments(ColourImage(64, 64, kTissue))), 0);
  EXPECT_EQ(marked(detectInstruments(ColourImage(64, 64, {0, 0, 0}))), 0);
  EXPECT_TRUE(detectInstruments({}).empty());
}

}  // namespace
}  // namespace softscope
