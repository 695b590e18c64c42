// tests/features/masks_test.cpp: highlights are found, tissue is left alone.
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "features/highlight_mask.h"

namespace softscope {
namespace {

constexpr Rgb8 kTissue{180, 90, 70}, kFat{230, 200, 150};

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

TEST(ClippedMask, IsTheInsideOfWhatIsClippedInAllChannels) {
  ColourImage image(100, 80, kTissue);
  paint(&image, 20, 20, 50, 45, {255, 252, 250});
  paint(&image, 60, 20, 72, 32, {255, 255, 255});  // no window of 13 px fits in
  paint(&image, 60, 50, 90, 75, {255, 255, 200});
  const Mask mask = clippedMask(image);
  EXPECT_EQ(marked(mask), (30 - 12) * (25 - 12));
  EXPECT_EQ(mask.at(26, 26), 1);
  EXPECT_EQ(mask.at(25, 26), 0);
  EXPECT_TRUE(clippedMask(ColourImage(100, 80, kTissue)).empty());
  EXPECT_TRUE(clippedMask({}).empty());
}

}  // namespace
}  // namespace softscope
