// tests/features/masks_test.cpp: highlights are found, tissue is left alone.
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "features/highlight_mask.h"
#include "support/paint.h"

namespace softscope {
namespace {

constexpr Rgb8 kTissue{180, 90, 70}, kFat{230, 200, 150};

int marked(const Mask& mask) { return std::accumulate(mask.values.begin(), mask.values.end(), 0); }

TEST(HighlightMask, MarksWhiteWithItsHaloAndNothingElse) {
  ColourImage image(100, 80, kTissue);
  test::paint(&image, 10, 10, 30, 30, kFat);
  test::paint(&image, 60, 40, 64, 44, {255, 252, 246});
  test::paint(&image, 80, 40, 84, 44, {255, 120, 90});  // saturated red is no highlight
  const Mask mask = highlightMask(image);
  EXPECT_EQ(marked(mask), 6 * 6);  // 4 px and 1 px of halo on both sides
  EXPECT_EQ(mask.at(59, 39), 1);
  EXPECT_EQ(mask.at(58, 39), 0);
  EXPECT_TRUE(highlightMask({}).empty());
}

}  // namespace
}  // namespace softscope
