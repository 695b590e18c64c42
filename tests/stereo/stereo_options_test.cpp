// tests/stereo/stereo_options_test.cpp: wrong options are refused by name.
#include "stereo/options/stereo_options.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace softscope {
namespace {

void expectRefused(const StereoOptions& options, const std::string& field) {
  try {
    options.validate();
    FAIL() << field << " was accepted";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
  }
}

TEST(StereoOptions, HaveValidDefaults) { EXPECT_NO_THROW(StereoOptions{}.validate()); }

TEST(StereoOptions, HaveARangeThatGrowsWithTheImage) {
  const StereoOptions automatic;
  EXPECT_EQ(automatic.forWidth(640).disparity_max_px, 255);
  EXPECT_EQ(automatic.forWidth(320).disparity_max_px, 255);
  EXPECT_EQ(automatic.forWidth(1280).disparity_max_px, 511);
  EXPECT_EQ(automatic.forWidth(4096).disparity_max_px, StereoOptions::kLargestDisparityPx);
  StereoOptions fixed;
  fixed.disparity_max_px = 100;
  EXPECT_EQ(fixed.forWidth(1280).disparity_max_px, 100);
}

TEST(StereoOptions, RefuseWrongValuesByName) {
  StereoOptions o;
  o.method = "elass";
  expectRefused(o, "stereo.method");
  o = {};
  o.disparity_max_px = -1;
  expectRefused(o, "stereo.disparity_max_px");
  o = {};
  o.disparity_min_px = 255;
  expectRefused(o.forWidth(320), "stereo.disparity_max_px");
  o = {};
  o.disparity_max_px = 5000;
  expectRefused(o, "stereo.disparity_max_px");
  o = {};
  o.elas.coarser_levels = -1;
  expectRefused(o, "stereo.elas.coarser_levels");
  o = {};
  o.smoothing.reach_blocks = -1;
  expectRefused(o, "stereo.smoothing.reach_blocks");
}

}  // namespace
}  // namespace softscope
