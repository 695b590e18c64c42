// tests/stereo/mask_leaks_test.cpp: disparity of an instrument next to its mask.
#include "stereo/refinement/mask_leaks.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace softscope {
namespace {

constexpr float kUnmeasured = std::numeric_limits<float>::quiet_NaN();

/// Tissue of 20 px; from the left border to column 29 a masked instrument, whose disparity of 60 px
/// reaches to column `leak_end`. From row `contact` on the tissue rises to it in a ramp.
struct MaskedView {
  Mask mask = Mask(120, 100, 0);
  Raster<float> disparity_px = Raster<float>(120, 100, 20.0f);

  explicit MaskedView(int leak_end, int contact = 100) {
    for (int v = 0; v < 100; ++v)
      for (int u = 0; u < 120; ++u) {
        if (u < 30) mask.at(u, v) = 255;
        if (u < leak_end) disparity_px.at(u, v) = 60;
        if (u < 80 && v >= contact) disparity_px.at(u, v) = 20 + 0.8f * static_cast<float>(80 - u);
        if (u < 30) disparity_px.at(u, v) = kUnmeasured;
      }
  }
  bool leaks(int u, int v) const { return leaksOf(mask, disparity_px).at(u, v) != 0; }
};

TEST(MaskLeaks, EndAtTheStepToTheTissue) {
  const MaskedView view(42);
  EXPECT_TRUE(view.leaks(41, 50));
  EXPECT_FALSE(view.leaks(42, 50));
  EXPECT_FALSE(view.leaks(119, 50));
}

TEST(MaskLeaks, AreAllWithinHalfAWindow) {
  const MaskedView view(30);
  EXPECT_TRUE(view.leaks(35, 50));
  EXPECT_FALSE(view.leaks(36, 50));
}

// Where the instrument holds tissue, no step parts them; along its shaft one does.
TEST(MaskLeaks, AreNoTissueThatIsHeld) {
  const MaskedView view(42, 60);
  EXPECT_FALSE(view.leaks(38, 80));
  EXPECT_TRUE(view.leaks(38, 10));
}

TEST(MaskLeaks, AreNoneWithoutAMaskOrDepth) {
  MaskedView view(42);
  view.disparity_px.at(33, 7) = kUnmeasured;
  const Mask leaks = leaksOf(view.mask, view.disparity_px);
  EXPECT_EQ(leaks.at(45, 7), 0);
  view.mask = Mask(120, 100, 0);
  const Mask none = leaksOf(view.mask, view.disparity_px);
  for (const std::uint8_t value : none.values) ASSERT_EQ(value, 0);
  EXPECT_THROW(leaksOf(Mask(3, 3, 0), view.disparity_px), Error);
}

}  // namespace
}  // namespace softscope
