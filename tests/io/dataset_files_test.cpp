// tests/io/dataset_files_test.cpp: files of known data sets, written, read back, and broken.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "io/calibrations/calibration_reader.h"
#include "io/datasets/stir_files.h"
#include "io/datasets/surgt_files.h"
#include "io/geometry/xyz_files.h"
#include "io/images/image_writer.h"
#include "io/sequences/dataset_form.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

StereoCalibration scope() {
  StereoCalibration scope;
  scope.left.pinhole = {640, 480, 567.5, 567.5, 318, 241};
  scope.right.pinhole = scope.left.pinhole;
  scope.right_from_left.translation().x() = -4.14;
  return scope;
}

TEST(StirFiles, AnnotationsComeBack) {
  StirAnnotations written;
  written[0] = {{10.5, 20, 30.25, true, true}, {1, 2, 3, true, false}};
  written[7] = {{11, 21, 30, false, true}, {-4, 2, 3, false, false}};
  const StirAnnotations read = parseStirAnnotations(stirAnnotationsJson(written), "a");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read.at(7)[0].left_u_px, 11);
  EXPECT_EQ(read.at(0)[0].disparity_px, 30.25);
  EXPECT_TRUE(read.at(7)[0].right_visible);
  EXPECT_FALSE(read.at(7)[1].left_visible);
  EXPECT_EQ(read.at(7)[1].left_u_px, -4);
}

TEST(StirFiles, ManyPointsAreRead) {
  StirAnnotations written;
  written[0].resize(500, {1, 2, 3, true, true});
  EXPECT_EQ(parseStirAnnotations(stirAnnotationsJson(written), "a").at(0).size(), 500u);
}

TEST(StirFiles, OtherInstancesAreLeftOut) {
  const std::string one = R"({"left_x":[1],"left_y":[2],"disparity":[3],"left_visibility":[true],)"
                          R"("right_visibility":[false]})";
  EXPECT_EQ(parseStirAnnotations("{\"0/0\":" + one + ",\"1/3\":" + one + "}", "a").size(), 1u);
}

TEST(StirFiles, BrokenAnnotationsAreNamed) {
  const auto refuses = [](const std::string& text, const std::vector<std::string>& parts) {
    expectError<InputError>([&] { parseStirAnnotations(text, "a.json"); }, parts);
  };
  const std::string good = stirAnnotationsJson({{0, {{1, 2, 3, true, true}}}});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  refuses("[]", {"a.json", "object"});
  refuses("{}", {"a.json", "no frame"});
  refuses(good.substr(0, good.size() / 2), {"a.json"});
  refuses(with("0/0", "zero"), {"a.json", "FRAME/INSTANCE"});
  refuses(with("0/0", "-1/0"), {"FRAME/INSTANCE"});
  refuses(with("[2.0]", "[]"), {"0/0", "left_y", "one a point"});
  refuses(with("[2.0]", "[\"x\"]"), {"0/0", "left_y"});
  refuses(with("disparity", "depth"), {"0/0", "disparity is missing"});
  refuses(with("[true]", "[2]"), {"left_visibility", "true or false"});
}

TEST(StirFiles, QueriesComeBackInBothForms) {
  const auto read = parseStirQueries(stirQueriesJson({{1.5, 2}, {3, 4}}), "q");
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].x(), 1.5);
  EXPECT_EQ(parseStirQueries(R"({"left_x":[1],"left_y":[2]})", "q").size(), 1u);
  expectError<InputError>([] { parseStirQueries("{\"a\":1}", "q.json"); }, {"q.json", "left_x"});
}

TEST(StirFiles, TheCalibrationIsInMetresAndComesBack) {
  const StereoCalibration read = parseCalibration(stirCalibrationJson(scope()), "calib.json");
  EXPECT_NEAR(read.right_from_left.translation().x(), -4.14, 1e-12);
  EXPECT_EQ(read.left.pinhole.fx_px, 567.5);
  EXPECT_EQ(read.form, "STIR 2026");
  StereoCalibration rational = scope();
  rational.left.distortion.coefficients[5] = 0.1;
  EXPECT_THROW(stirCalibrationJson(rational), OptionError);
}

TEST(StirFiles, TheFirstFormsCalibrationIsReadToo) {
  const auto read = parseCalibration(
      R"({"leftcameramat":[[1035,0,597],[0,1035,520],[0,0,1]],)"
      R"("rightcameramat":[[1035,0,688],[0,1035,520],[0,0,1]],"leftdistortioncoeffs":[0,0,0,0,0],)"
      R"("rightdistortioncoeffs":[0,0,0,0,0],"rotation":[[1,0,0],[0,1,0],[0,0,1]],)"
      R"("translation":[-0.0041,0,0]})",
      "calib.json");
  EXPECT_NEAR(read.baseline_mm(), 4.1, 1e-12);
  EXPECT_EQ(read.form, "STIR");
}

TEST(StirFiles, PredictionsAreInMetres) {
  StirPrediction one;
  one.positions_mm = {{1, 2, 80}};
  one.visible = {true};
  one.latency_ms = 12;
  const std::string text = stirPredictionsJson({{"seq", {{3, one}}}});
  EXPECT_EQ(text,
            "{\"seq\":{\"3\":{\"coords\":[[0.001,0.002,0.08]],\"visibilities\":[true],"
            "\"latency_ms\":12.0}}}\n");
}

TEST(SurgtFiles, InfoComesBack) {
  SurgtInfo written;
  written.width_px = 1280;
  written.height_px = 1024;
  written.video = "video.mp4";
  written.truth = {"gt_rectified_0.yaml", "gt_rectified_1.yaml"};
  const SurgtInfo read = parseSurgtInfo(surgtInfoYaml(written), "info.yaml");
  EXPECT_EQ(read.height_px, 1024);
  EXPECT_EQ(read.truth, written.truth);
  EXPECT_FALSE(read.side_by_side);
  std::string text = surgtInfoYaml(written);
  text.replace(text.find("vertical"), 8, "diagonal");
  expectError<InputError>([&] { parseSurgtInfo(text, "info.yaml"); }, {"info.yaml", "diagonal"});
  written.video = "../video.mp4";
  expectError<InputError>([&] { parseSurgtInfo(surgtInfoYaml(written), "i"); }, {"same folder"});
  written.video = "v.mp4";
  written.width_px = 0;
  expectError<InputError>([&] { parseSurgtInfo(surgtInfoYaml(written), "i"); }, {"width"});
}

TEST(SurgtFiles, BoxesComeBackInlineAndAsBlocks) {
  std::vector<SurgtFrame> written(3);
  written[0].visible_in_both = true;
  written[0].boxes = {{{10.5, 20, 30, 40}, {5, 20, 30, 40}}};
  written[2].difficult = true;
  const auto read = parseSurgtTruth(surgtTruthYaml(written), "gt");
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ((*read[0].boxes)[0][0], 10.5);
  EXPECT_FALSE(read[1].boxes || read[1].visible_in_both);
  EXPECT_TRUE(read[2].difficult);
  const auto block = parseSurgtTruth(
      "- - true\n  - false\n  - - - 1\n      - 2\n      - 3\n      - 4\n    - - 0\n      - 2\n"
      "      - 3\n      - 4\n- - false\n  - false\n  - null\n",
      "gt");
  ASSERT_EQ(block.size(), 2u);
  EXPECT_EQ((*block[0].boxes)[1][0], 0);
}

TEST(SurgtFiles, BrokenBoxesAreNamed) {
  const auto refuses = [](const std::string& text, const std::vector<std::string>& parts) {
    expectError<InputError>([&] { parseSurgtTruth(text, "gt.yaml"); }, parts);
  };
  refuses("a: 1\n", {"gt.yaml", "list"});
  refuses("- [true, false]\n", {"frame 0", "visible_in_both"});
  refuses("- [false, false, null]\n- [true, false, null]\n", {"frame 1", "no boxes"});
  refuses("- [true, false, [[1, 2, 3, 4]]]\n", {"frame 0", "left and a right"});
  refuses("- [true, false, [[1, 2, 3], [1, 2, 3, 4]]]\n", {"3 numbers"});
  refuses("- [true, false, [[1, 2, 0, 4], [1, 2, 3, 4]]]\n", {"above 0"});
  refuses("- [perhaps, false, null]\n", {"neither true nor false"});
}

/// A TIFF of 2 x 1 pixels, three 32-bit floats each, without compression; little endian.
std::string handMadeTiff(const std::vector<float>& values) {
  std::string bytes("II*\0\x08\0\0\0", 8);
  const auto put16 = [&](int n) { bytes += char(n & 255), bytes += char(n >> 8); };
  const auto put32 = [&](int n) { put16(n & 65535), put16(n >> 16); };
  const auto entry = [&](int tag, int type, int count, int value) {
    put16(tag), put16(type), put32(count), put32(value);
  };
  const int entries = 10, after = 8 + 2 + 12 * entries + 4;
  put16(entries);
  entry(256, 4, 1, 2);           // width
  entry(257, 4, 1, 1);           // height
  entry(258, 3, 3, after);       // bits of each channel
  entry(259, 3, 1, 1);           // no compression
  entry(262, 3, 1, 2);           // RGB
  entry(273, 4, 1, after + 12);  // where the pixels begin
  entry(277, 3, 1, 3);           // channels
  entry(278, 4, 1, 1);           // rows a strip
  entry(279, 4, 1, 24);          // bytes
  entry(339, 3, 3, after + 6);   // floats
  put32(0);
  for (int i = 0; i < 3; ++i) put16(32);
  for (int i = 0; i < 3; ++i) put16(3);
  for (const float value : values) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    bytes.append(raw, 4);
  }
  return bytes;
}

TEST(XyzFiles, ChannelsAreXYZInTheFilesOrder) {
  const PointRaster points = parsePointRaster(handMadeTiff({1, 2, 80, 0, 0, 0}), "p.tiff");
  ASSERT_EQ(points.width_px, 2);
  EXPECT_EQ(points.at(0, 0), Eigen::Vector3f(1, 2, 80));
  EXPECT_TRUE(std::isnan(points.at(1, 0).z()));
}

TEST(XyzFiles, PointsComeBack) {
  const TemporaryFolder folder;
  PointRaster written(3, 2, Eigen::Vector3f::Constant(NAN));
  written.at(1, 0) = {1, -2, 80};
  written.at(2, 1) = {5, 6, 70.5F};
  writePointRaster(folder / "p.tiff", written);
  const PointRaster read = readPointRaster(folder / "p.tiff");
  EXPECT_EQ(read.at(1, 0), written.at(1, 0));
  EXPECT_EQ(read.at(2, 1), written.at(2, 1));
  EXPECT_TRUE(std::isnan(read.at(0, 0).x()));
  EXPECT_THROW(writePointRaster(folder / "p.tiff", written), OptionError);
  writePng(folder / "gray.png", GrayImage(4, 4, 7));
  expectError<InputError>([&] { readPointRaster(folder / "gray.png"); }, {"gray.png", "three"});
}

TEST(XyzFiles, RectifiedDepthRotatesPointsAndKeepsTheNearest) {
  RectifiedRig rig;
  rig.left = {8, 6, 10, 10, 3.5, 2.5};
  const double angle = 0.1;
  rig.rectified_from_raw_left =
      Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  PointRaster points(2, 1, Eigen::Vector3f::Constant(NAN));
  const Eigen::Vector3d near(0.5, 0.5, 10), far(1, 1, 20);  // both into pixel (4, 3)
  points.at(0, 0) = (rig.rectified_from_raw_left.transpose() * far).cast<float>();
  points.at(1, 0) = (rig.rectified_from_raw_left.transpose() * near).cast<float>();
  const Raster<float> depth_mm = rectifiedDepth(points, rig);
  EXPECT_NEAR(depth_mm.at(4, 3), 10, 1e-5);
  int known = 0;
  for (const float z : depth_mm.values) known += std::isfinite(z);
  EXPECT_EQ(known, 1);
}

}  // namespace
}  // namespace softscope::test
