#include "io/sequences/stereo_packing.h"

#include <gtest/gtest.h>

#include "io/images/image_reader.h"
#include "io/sequence_folder.h"
#include "support/data_folder.h"

namespace softscope::test {
namespace {

const ExpectedView kUnknown{};

void expectSame(const StereoPair& found, const StereoPair& wanted) {
  ASSERT_TRUE(found.left.sameShape(wanted.left));
  EXPECT_EQ(meanDifference(found.left, wanted.left), 0);
  EXPECT_EQ(meanDifference(found.right, wanted.right), 0);
}

TEST(StereoPacking, PartsEveryLayoutExactly) {
  const StereoPair pair = testPair(0);
  expectSame(unpack(sideBySide(pair), {StereoLayout::kSideBySide, false, false}, "x"), pair);
  expectSame(unpack(topBottom(pair), {StereoLayout::kTopBottom, false, false}, "x"), pair);
  expectSame(unpack(interlaced(pair), {StereoLayout::kInterlaced, false, false}, "x"), pair);
  expectSame(
      unpack(sideBySide({pair.right, pair.left}), {StereoLayout::kSideBySide, true, false}, "x"),
      pair);
}

TEST(StereoPacking, FullHeightKeepsRowsWhereTheyWere) {
  const StereoPair pair = testPair(0);
  ColourImage packed = pair.left;
  for (int v = 1; v < kHeight; v += 2) std::copy_n(pair.right.row(v), kWidth, packed.row(v));
  const StereoPair found = unpack(packed, {StereoLayout::kInterlaced, false, true}, "x");
  ASSERT_EQ(found.left.height_px, kHeight);
  EXPECT_EQ(found.left.at(5, 4), pair.left.at(5, 4));
  EXPECT_EQ(found.right.at(5, 7), pair.right.at(5, 7));
  const int between = (pair.left.at(5, 4).red + pair.left.at(5, 6).red + 1) / 2;
  EXPECT_EQ(found.left.at(5, 5).red, between);
  EXPECT_EQ(found.right.at(5, 0), pair.right.at(5, 1));  // no neighbour above
}

TEST(StereoPacking, AutoTellsTheLayoutWithoutACalibration) {
  for (int i = 0; i < 5; ++i) {
    const StereoPair pair = testPair(i);
    const auto chosen = [&](const ColourImage& packed) {
      return choosePacking(packed, "auto", false, kUnknown, "x").layout;
    };
    EXPECT_EQ(chosen(sideBySide(pair)), StereoLayout::kSideBySide);
    EXPECT_EQ(chosen(topBottom(pair)), StereoLayout::kTopBottom);
    EXPECT_EQ(chosen(interlaced(pair)), StereoLayout::kInterlaced);
  }
}

TEST(StereoPacking, AutoUsesTheCalibrationsSize) {
  const StereoPair pair = testPair(0);
  const ColourImage flat(2 * kWidth, kHeight, Rgb8{9, 9, 9});  // nothing to correlate
  EXPECT_EQ(choosePacking(flat, "auto", false, {kWidth, kHeight}, "x").layout,
            StereoLayout::kSideBySide);
  ColourImage rows_of_both = pair.left;
  for (int v = 1; v < kHeight; v += 2) std::copy_n(pair.right.row(v), kWidth, rows_of_both.row(v));
  const auto full = choosePacking(rows_of_both, "auto", false, {kWidth, kHeight}, "x");
  EXPECT_EQ(full.layout, StereoLayout::kInterlaced);
  EXPECT_TRUE(full.full_height);
  expectError<InputError>(
      [&] {
        choosePacking(flat, "auto", false, {100, 100}, "v.mp4");
      },
      {"v.mp4", "320 x 120", "100 x 100", "black borders"});
}

TEST(StereoPacking, OneViewOfTheCalibrationsSizeIsNotInterlaced) {
  const ColourImage left = testPair(0).left, black(kWidth, kHeight);
  const ExpectedView view{kWidth, kHeight};
  for (const ColourImage& image : {left, black})
    expectError<InputError>([&] { choosePacking(image, "auto", false, view, "left.mp4"); },
                            {"left.mp4: one view of 160 x 120", "right image is missing",
                             "sequence.layout=interlaced"});
  EXPECT_TRUE(choosePacking(left, "interlaced", false, view, "x").full_height);
}

TEST(StereoPacking, SqueezedViewsAreNamed) {
  const StereoPair wide{makeTexture(kWidth / 2, kHeight, 0, 3),
                        makeTexture(kWidth / 2, kHeight, 5, 3)};
  expectError<InputError>(
      [&] {
        choosePacking(sideBySide(wide), "auto", false, {kWidth, kHeight}, "v.mp4");
      },
      {"v.mp4", "halves look alike", "side-by-side", "half the width"});
}

TEST(StereoPacking, AGivenLayoutWins) {
  const auto chosen =
      choosePacking(sideBySide(testPair(0)), "top-bottom", true, {kWidth, kHeight}, "x");
  EXPECT_EQ(chosen.layout, StereoLayout::kTopBottom);
  EXPECT_TRUE(chosen.right_first);
  expectError<OptionError>([] { choosePacking(ColourImage(4, 4), "diagonal", false, {}, "x"); },
                           {"sequence.layout", "diagonal", "side-by-side"});
}

TEST(StereoPacking, WhatCannotBeToldIsAnError) {
  expectError<InputError>([] { choosePacking(ColourImage(320, 120), "auto", false, {}, "v.mp4"); },
                          {"v.mp4", "sequence.layout"});
  // One ordinary picture holds no two views.
  expectError<InputError>([] { choosePacking(makeTexture(160, 120), "auto", false, {}, "v.mp4"); },
                          {"v.mp4"});
  expectError<InputError>(
      [] {
        unpack(ColourImage(5, 4), {StereoLayout::kSideBySide, false, false}, "v.mp4");
      },
      {"v.mp4", "5 x 4", "halved"});
}

TEST(StereoPacking, AutoTellsRealScopes) {
  SOFTSCOPE_DATA_OR_SKIP(data, "endonerf_pulling");
  const std::vector<std::string> pairs[] = {
      {"endonerf_pulling/left/000062.jpg", "endonerf_pulling/right/000062.jpg"},
      {"opencas_ct/left.png", "opencas_ct/right.png"},
      {"bdis_tissue/left/000003.png", "bdis_tissue/right/000003.png"},
      {"openhelp_kidney_small/left/000020.png", "openhelp_kidney_small/right/000020.png"}};
  for (const auto& names : pairs) {
    SCOPED_TRACE(names[0]);
    const StereoPair pair{readColourImage(dataFolder(names[0])),
                          readColourImage(dataFolder(names[1]))};
    const auto chosen = [&](const ColourImage& packed) {
      return choosePacking(packed, "auto", false, kUnknown, "x").layout;
    };
    EXPECT_EQ(chosen(sideBySide(pair)), StereoLayout::kSideBySide);
    EXPECT_EQ(chosen(topBottom(pair)), StereoLayout::kTopBottom);
    EXPECT_EQ(chosen(interlaced(pair)), StereoLayout::kInterlaced);
    const ExpectedView view{pair.left.width_px, pair.left.height_px};
    ColourImage rows = pair.left;
    for (int v = 1; v < rows.height_px; v += 2)
      std::copy_n(pair.right.row(v), rows.width_px, rows.row(v));
    EXPECT_TRUE(choosePacking(rows, "auto", false, view, "x").full_height);
    for (const ColourImage& one : {pair.left, pair.right})
      expectError<InputError>([&] { choosePacking(one, "auto", false, view, "x"); }, {"one view"});
  }
}

}  // namespace
}  // namespace softscope::test
