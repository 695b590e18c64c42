// tests/stereo/clipped_mask_test.cpp: highlights with and without room for a window.
#include "stereo/refinement/clipped_mask.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/paint.h"

namespace softscope {
namespace {

constexpr Rgb8 kRedTissue{180, 90, 70};

TEST(ClippedMask, IsTheInsideOfWhatIsClippedInAllChannels) {
  ColourImage image(100, 80, kRedTissue);
  test::paint(&image, 20, 20, 50, 45, {255, 252, 250});
  test::paint(&image, 60, 20, 72, 32, {255, 255, 255});  // no window of 13 px fits in
  test::paint(&image, 60, 50, 90, 75, {255, 255, 200});
  const Mask mask = clippedMask(image);
  EXPECT_EQ(std::accumulate(mask.values.begin(), mask.values.end(), 0), (30 - 12) * (25 - 12));
  EXPECT_EQ(mask.at(26, 26), 1);
  EXPECT_EQ(mask.at(25, 26), 0);
  EXPECT_TRUE(clippedMask(ColourImage(100, 80, kRedTissue)).empty());
  EXPECT_TRUE(clippedMask({}).empty());
}

}  // namespace
}  // namespace softscope
