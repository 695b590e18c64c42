// tests/apps/test_evaluate_maps.cpp: `softscope evaluate` of disparity and depth maps.
#include <cmath>
#include <fstream>

#include "core/raster.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class EvaluateMaps : public InFolder {
 protected:
  /// The truth is 20 px; the measured map is 1.5 px too high in its left half, 0.25 px elsewhere,
  /// and lacks its two lowest rows.
  void SetUp() override {
    InFolder::SetUp();
    Raster<float> truth(40, 20, 20.0f), measured(40, 20, 20.25f);
    for (int v = 0; v < 20; ++v)
      for (int u = 0; u < 20; ++u) measured.at(u, v) = 21.5f;
    for (int v = 18; v < 20; ++v)
      for (int u = 0; u < 40; ++u) measured.at(u, v) = std::nanf("");
    fs::create_directories(at("maps"));
    fs::create_directories(at("truth"));
    for (const char* number : {"000000", "000005"}) {
      writePfm(at(std::string("maps/") + number + "_disparity.pfm"), measured);
      writePfm(at(std::string("truth/") + number + ".pfm"), truth);
    }
  }
  Outcome evaluate(std::vector<std::string> more) const {
    more.insert(more.begin(), "evaluate");
    return softscope::test::run(more);
  }
};

TEST_F(EvaluateMaps, ADisparityMapHasItsErrorsCoverageAndBadPixels) {
  const Outcome outcome =
      evaluate({at("maps/000000_disparity.pfm"), "--reference", at("truth/000000.pfm"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json disparity = outcome.json()["disparity"];
  EXPECT_NEAR(disparity["epe_px"], 0.875, 1e-6);
  EXPECT_NEAR(disparity["bad_1px_percent"], 50, 1e-6);
  EXPECT_NEAR(disparity["bad_2px_percent"], 0, 1e-6);
  EXPECT_NEAR(disparity["coverage_percent"], 90, 1e-6) << "two of twenty rows lack";
  EXPECT_TRUE(outcome.json()["depth"]["mae_mm"].is_null()) << "mm take a calibration";
}

TEST_F(EvaluateMaps, TheErrorsOfTheWorstMapAreDrawnPixelByPixel) {
  // The second map is 1 px worse: it is the one that is drawn.
  Raster<float> worse = readDisparity(at("maps/000005_disparity.pfm"));
  for (float& value : worse.values) value += 1;
  writePfm(at("maps/000005_disparity.pfm"), worse, true);
  ASSERT_EQ(evaluate({at("maps"), "--reference", at("truth"), "--out", at("out")}).exit_code, 0);
  const std::string svg = textOf(at("out/error_map.svg"));
  EXPECT_THAT(svg, HasSubstr("000005_disparity.pfm: mean error 1.88 px, the largest of 2 maps"));
  EXPECT_THAT(svg, HasSubstr("error of disparity [px]"));
  EXPECT_THAT(svg, HasSubstr("not measured, or no truth"));
  // 40 x 20 pixels over the whole width: left 2.5 px off, right 1.25, the lowest rows grey.
  const ColourImage picture = readColourImage(at("out/error_map.png"));
  const int top = picture.height_px / 4, step = picture.width_px / 4;
  const Rgb8 left = picture.at(step, top + step / 2), right = picture.at(3 * step, top + step / 2);
  EXPECT_GT(left.red, 200) << "yellow, the end of viridis";
  EXPECT_LT(left.blue, 90);
  EXPECT_LT(right.red, 90) << "its middle";
  EXPECT_GT(right.green, 110);
  EXPECT_TRUE(fs::exists(at("out/error_map.pdf")));
  ASSERT_EQ(evaluate({at("out/../maps/000000_disparity.pfm"), "--reference", at("truth/000000.pfm"),
                      "--out", at("out"), "--force"})
                .exit_code,
            0);
  EXPECT_THAT(textOf(at("out/error_map.svg")), HasSubstr("000000_disparity.pfm: mean error 0.88"));
}

TEST_F(EvaluateMaps, WithACalibrationErrorsAreInMillimetresToo) {
  makeWallTruth(at("clip"), 1, false);
  const RectifiedRig rig = sequenceRig();
  const double product = rig.left.fx_px * rig.baseline_mm;
  const Outcome outcome = evaluate({at("maps"), "--reference", at("truth"), "--calibration",
                                    at("clip/calibration.yaml"), "--json", "--out", at("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["maps_judged"], 2);
  const double left_mm = product / 20 - product / 21.5, right_mm = product / 20 - product / 20.25;
  EXPECT_NEAR(outcome.json()["depth"]["mae_mm"], (left_mm + right_mm) / 2, 1e-4);
  EXPECT_NEAR(outcome.json()["depth"]["bias_mm"], -(left_mm + right_mm) / 2, 1e-4) << "too near";
  EXPECT_EQ(Json::parse(textOf(at("out/evaluation.json"))), outcome.json());
  EXPECT_THAT(textOf(at("out/maps.csv")), testing::StartsWith("map,epe_px,"));
}

TEST_F(EvaluateMaps, ConfidenceIsHeldAgainstTheErrors) {
  GrayImage confidence(40, 20, 230);  // a sigma of 0.30 px
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 20; ++u) confidence.at(u, v) = 40;  // of 2.5 px
  writePng(at("confidence.png"), confidence);
  const Outcome outcome =
      evaluate({at("maps/000000_disparity.pfm"), "--reference", at("truth/000000.pfm"),
                "--confidence", at("confidence.png"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["sigma"]["within_95_share"], 1);
  EXPECT_NEAR(outcome.json()["sigma"]["half_left"], 0.25, 1e-6) << "the unsure half is the bad one";
  EXPECT_NEAR(outcome.json()["sigma"]["ause"], 0, 1e-6);
  const Outcome told = evaluate({at("maps/000000_disparity.pfm"), "--reference",
                                 at("truth/000000.pfm"), "--confidence", at("confidence.png")});
  EXPECT_THAT(told.out, HasSubstr("50, 68 and 95 % intervals"));
}

TEST_F(EvaluateMaps, ADepthMapIsNotTakenForADisparityMap) {
  const std::string map = at("maps/000000_disparity.pfm");
  const auto refused = [&](const std::string& truth, const char* part) {
    const Outcome outcome = evaluate({map, "--reference", truth, "--map", "disparity"});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  };
  // By its name, or that of its folder.
  writeDepthPng(at("000000_depth.png"), Raster<float>(40, 20, 50.0f));
  refused(at("000000_depth.png"), "is called a depth map");
  fs::create_directories(at("depth"));
  writeDepthPng(at("depth/000000.png"), Raster<float>(40, 20, 50.0f));
  refused(at("depth/000000.png"), "is called a depth map");
  // By its values: 50 mm are no disparity in an image of 40 px.
  writePfm(at("wide.pfm"), Raster<float>(40, 20, 50.0f));
  refused(at("wide.pfm"), "a disparity is at most 40 px");
  // By both: depth falls where disparity rises. A slope of 8 to 28 px, f times baseline 700 px mm;
  // 25 to 88 mm are 10 to 34 px where 100 steps per mm are read as 256 per px.
  Raster<float> disparity(40, 20), depth(40, 20);
  for (std::size_t i = 0; i < disparity.size(); ++i) {
    disparity.values[i] = 8 + 0.5f * float(i % 40);
    depth.values[i] = 700 / disparity.values[i];
  }
  writePfm(at("slope_disparity.pfm"), disparity);
  writeDepthPng(at("slope.png"), depth);
  const Outcome doubted =
      evaluate({at("slope_disparity.pfm"), "--reference", at("slope.png"), "--json"});
  ASSERT_EQ(doubted.exit_code, 0) << doubted.err;
  EXPECT_THAT(doubted.json()["warnings"].dump(),
              HasSubstr("its values fall where the true ones rise (correlation -0.9"));
  writeDisparityPng(at("same.png"), disparity);
  const Outcome same =
      evaluate({at("slope_disparity.pfm"), "--reference", at("same.png"), "--json"});
  EXPECT_EQ(same.json()["warnings"].size(), 0u) << same.err;
  EXPECT_EQ(same.json()["comparison"]["measured_values"], "px");
  EXPECT_EQ(same.json()["comparison"]["reference_values"], "16 bits, 256 steps per px");
}

TEST_F(EvaluateMaps, LimitsAndMistakesAreTold) {
  const std::string map = at("maps/000000_disparity.pfm"), truth = at("truth/000000.pfm");
  EXPECT_EQ(evaluate({map, "--reference", truth, "--fail-if", "epe_px>0.5"}).exit_code, 1);
  EXPECT_EQ(evaluate({map, "--reference", truth, "--fail-if", "epe>0.5"}).exit_code, 2);
  EXPECT_EQ(evaluate({map, "--reference", truth, "--align", "icp"}).exit_code, 2);
  fs::copy_file(map, at("map.pfm"));
  const Outcome unnamed = evaluate({at("map.pfm"), "--reference", truth});
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_THAT(unnamed.err, HasSubstr("--map"));
  EXPECT_EQ(evaluate({at("map.pfm"), "--reference", truth, "--map", "disparity"}).exit_code, 0);
  fs::remove(at("truth/000005.pfm"));
  const Outcome lonely = evaluate({at("maps"), "--reference", at("truth")});
  EXPECT_EQ(lonely.exit_code, 3);
  EXPECT_THAT(lonely.err, HasSubstr("000005_disparity.pfm: has no partner"));
}

}  // namespace
}  // namespace softscope::test
