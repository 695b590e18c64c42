// tests/stereo/grey_foreground_test.cpp: smoke before tissue, and grey that is tissue.
#include "stereo/refinement/grey_foreground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "support/paint.h"

namespace softscope {
namespace {

const PinholeCamera kCamera{320, 240, 340, 340, 159.5, 119.5};  // blocks of 4 px
constexpr Rgb8 kTissue{170, 105, 100}, kGrey{72, 71, 70};
constexpr float kTissueMm = 100, kSmokeMm = 50;

/// Tissue, and from column 200 on a surface of another colour at another depth.
struct TwoSurfaces {
  ColourImage left = ColourImage(320, 240, kTissue);
  Raster<float> depth_mm = Raster<float>(320, 240, kTissueMm);

  TwoSurfaces(const Rgb8& colour, float right_mm) {
    test::paint(&left, 200, 0, 320, 240, colour);
    setColumns(200, 320, [right_mm](int) { return right_mm; });
  }
  template <class Depth>
  void setColumns(int begin, int end, const Depth& depthAt) {
    for (int v = 0; v < 240; ++v)
      for (int u = begin; u < end; ++u) depth_mm.at(u, v) = depthAt(u);
  }
  Mask foreground() const { return greyForeground(left, depth_mm, kCamera); }
  bool isDropped(int u, int v) const {
    const Mask mask = foreground();
    return !mask.empty() && mask.at(u, v) != 0;
  }
};

TEST(GreyForeground, IsSmokeThatFloatsBeforeTissue) {
  const TwoSurfaces view(kGrey, kSmokeMm);
  EXPECT_TRUE(view.isDropped(201, 120));
  EXPECT_TRUE(view.isDropped(319, 239));
  EXPECT_FALSE(view.isDropped(199, 120));
  EXPECT_FALSE(view.isDropped(0, 0));
}

TEST(GreyForeground, IsNotColouredTissueInFront) {
  EXPECT_TRUE(TwoSurfaces({150, 95, 80}, kSmokeMm).foreground().empty());
}

// Far tissue in poor light is grey.
TEST(GreyForeground, IsNotWhatLiesBehindTheTissue) {
  EXPECT_TRUE(TwoSurfaces(kGrey, 150).foreground().empty());
}

// A step of 2 mm between blocks of 4 px at 100 mm is one of 60 degrees.
TEST(GreyForeground, IsNotGreyTissueThatRisesFromColouredTissue) {
  TwoSurfaces view(kGrey, kSmokeMm);
  view.setColumns(200, 320, [](int u) {
    return std::max(kSmokeMm, kTissueMm - 0.4F * static_cast<float>(u - 200));
  });
  EXPECT_TRUE(view.foreground().empty());
}

// Windows of the matcher carry the depth of tissue over its contour.
TEST(GreyForeground, IsWhatLiesBeyondTheRimThatTheMatcherWidened) {
  TwoSurfaces view(kGrey, kSmokeMm);
  view.setColumns(200, 212, [](int) { return kTissueMm; });
  EXPECT_FALSE(view.isDropped(205, 120));
  EXPECT_TRUE(view.isDropped(215, 120));
}

// At a contour a block has the colour of tissue and the depth of smoke.
TEST(GreyForeground, TakesMixedBlocksAtItsContourWithIt) {
  TwoSurfaces view(kGrey, kSmokeMm);
  view.setColumns(196, 200, [](int) { return kSmokeMm; });
  EXPECT_TRUE(view.isDropped(197, 120));
  EXPECT_FALSE(view.isDropped(195, 120));
}

TEST(GreyForeground, IsNothingInAGreyImage) {
  TwoSurfaces view(kGrey, kSmokeMm);
  std::fill(view.left.values.begin(), view.left.values.end(), Rgb8{120, 118, 116});
  EXPECT_TRUE(view.foreground().empty());
  view.left = ColourImage(320, 240, Rgb8{});
  EXPECT_TRUE(view.foreground().empty());
}

TEST(GreyForeground, IsNothingWhereNothingWasMeasured) {
  TwoSurfaces view(kGrey, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(view.foreground().empty());
  EXPECT_TRUE(greyForeground({}, {}, kCamera).empty());
  EXPECT_THROW(greyForeground(view.left, Raster<float>(3, 3, 1.0F), kCamera), Error);
}

}  // namespace
}  // namespace softscope
