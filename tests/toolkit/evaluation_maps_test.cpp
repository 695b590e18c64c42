// tests/toolkit/evaluation_maps_test.cpp: disparity and depth maps against true ones.
#include <cmath>
#include <fstream>

#include "core/raster.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "tests/toolkit/evaluation_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class EvaluationOfMaps : public InFolder {
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
  static EvaluateOptions optionsOf(const std::string& measured, const std::string& reference) {
    EvaluateOptions options;
    options.run = measured;
    options.reference = reference;
    return options;
  }
  /// The first of the maps.
  EvaluateOptions first() const {
    return optionsOf(at("maps/000000_disparity.pfm"), at("truth/000000.pfm"));
  }
  static Json evaluated(const EvaluateOptions& options) {
    return written(evaluateRun(options).record);
  }
  /// Writes the files of the evaluation.
  Json evaluateInto(const std::string& out, const EvaluateOptions& options) const {
    const EvaluateOutputs outputs(at(out), /*overwrite=*/true);
    const RunEvaluation evaluation = evaluateRun(options);
    outputs.write(evaluation);
    return written(evaluation.record);
  }
};

TEST_F(EvaluationOfMaps, ADisparityMapHasItsErrorsCoverageAndBadPixels) {
  const Json record = evaluated(first());
  const Json& disparity = record["disparity"];
  EXPECT_NEAR(disparity["epe_px"], 0.875, 1e-6);
  EXPECT_NEAR(disparity["bad_1px_percent"], 50, 1e-6);
  EXPECT_NEAR(disparity["bad_2px_percent"], 0, 1e-6);
  EXPECT_NEAR(disparity["coverage_percent"], 90, 1e-6) << "two of twenty rows lack";
  EXPECT_TRUE(record["depth"]["mae_mm"].is_null()) << "mm take a calibration";
}

TEST_F(EvaluationOfMaps, TheErrorsOfTheWorstMapAreDrawnPixelByPixel) {
  // The second map is 1 px worse: it is the one that is drawn.
  Raster<float> worse = readDisparity(at("maps/000005_disparity.pfm"));
  for (float& value : worse.values) value += 1;
  writePfm(at("maps/000005_disparity.pfm"), worse, true);
  evaluateInto("out", optionsOf(at("maps"), at("truth")));
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
  evaluateInto("out", optionsOf(at("out/../maps/000000_disparity.pfm"), at("truth/000000.pfm")));
  EXPECT_THAT(textOf(at("out/error_map.svg")), HasSubstr("000000_disparity.pfm: mean error 0.88"));
}

TEST_F(EvaluationOfMaps, WithACalibrationErrorsAreInMillimetresToo) {
  makeWallTruth(at("clip"), 1, false);
  const RectifiedRig rig = sequenceRig();
  const double product = rig.left.fx_px * rig.baseline_mm;
  EvaluateOptions calibrated = optionsOf(at("maps"), at("truth"));
  calibrated.calibration = at("clip/calibration.yaml");
  const Json record = evaluateInto("out", calibrated);
  EXPECT_EQ(record["maps_judged"], 2);
  const double left_mm = product / 20 - product / 21.5, right_mm = product / 20 - product / 20.25;
  EXPECT_NEAR(record["depth"]["mae_mm"], (left_mm + right_mm) / 2, 1e-4);
  EXPECT_NEAR(record["depth"]["bias_mm"], -(left_mm + right_mm) / 2, 1e-4) << "too near";
  EXPECT_EQ(Json::parse(textOf(at("out/evaluation.json"))), record);
  EXPECT_THAT(textOf(at("out/maps.csv")), testing::StartsWith("map,epe_px,"));
}

TEST_F(EvaluationOfMaps, ConfidenceIsHeldAgainstTheErrors) {
  GrayImage confidence(40, 20, 230);  // a sigma of 0.30 px
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 20; ++u) confidence.at(u, v) = 40;  // of 2.5 px
  writePng(at("confidence.png"), confidence);
  EvaluateOptions options = first();
  options.confidence = at("confidence.png");
  const RunEvaluation evaluation = evaluateRun(options);
  const Json sigma = written(evaluation.record)["sigma"];
  EXPECT_EQ(sigma["within_95_share"], 1);
  EXPECT_NEAR(sigma["half_left"], 0.25, 1e-6) << "the unsure half is the bad one";
  EXPECT_NEAR(sigma["ause"], 0, 1e-6);
  EXPECT_THAT(evaluation.facts.text(), HasSubstr("50, 68 and 95 % intervals"));
}

TEST_F(EvaluationOfMaps, ADepthMapIsNotTakenForADisparityMap) {
  const std::string map = at("maps/000000_disparity.pfm");
  const auto refused = [&](const std::string& truth, const char* part) {
    EvaluateOptions options = optionsOf(map, truth);
    options.map_kind = "disparity";
    expectError<InputError>([&] { evaluateRun(options); }, {part});
  };
  // By its name, or that of its folder.
  writeDepthPng(at("000000_depth.png"), Raster<float>(40, 20, 50.0f));
  refused(at("000000_depth.png"), "is named a depth map");
  fs::create_directories(at("depth"));
  writeDepthPng(at("depth/000000.png"), Raster<float>(40, 20, 50.0f));
  refused(at("depth/000000.png"), "is named a depth map");
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
  const Json doubted = evaluated(optionsOf(at("slope_disparity.pfm"), at("slope.png")));
  EXPECT_THAT(doubted["warnings"].dump(),
              HasSubstr("its values fall where the true ones rise (correlation -0.9"));
  writeDisparityPng(at("same.png"), disparity);
  const Json same = evaluated(optionsOf(at("slope_disparity.pfm"), at("same.png")));
  EXPECT_EQ(same["warnings"].size(), 0u) << same["warnings"];
  EXPECT_EQ(same["comparison"]["measured_values"], "px");
  EXPECT_EQ(same["comparison"]["reference_values"], "16 bits, 256 steps per px");
}

TEST_F(EvaluationOfMaps, LimitsAndMistakesAreTold) {
  EvaluateOptions options = first();
  options.thresholds = limits({"epe_px>0.5"});
  EXPECT_TRUE(evaluateRun(options).outcomes.at(0).failed);
  options.thresholds = limits({"epe>0.5"});
  expectError<OptionError>([&] { evaluateRun(options); }, {"epe"});
  options = first();
  options.alignment = MeshAlignment::kIcp;
  expectError<OptionError>([&] { evaluateRun(options); }, {"`align=`"});
  fs::copy_file(at("maps/000000_disparity.pfm"), at("map.pfm"));
  options = optionsOf(at("map.pfm"), at("truth/000000.pfm"));
  expectError<OptionError>([&] { evaluateRun(options); }, {"`map_kind=`"});
  options.map_kind = "disparity";
  EXPECT_NEAR(evaluated(options)["disparity"]["epe_px"], 0.875, 1e-6);
  fs::remove(at("truth/000005.pfm"));
  expectError<InputError>([&] { evaluateRun(optionsOf(at("maps"), at("truth"))); },
                          {"000005_disparity.pfm: has no partner"});
}

}  // namespace
}  // namespace softscope::test
