// tests/toolkit/depth_test.cpp: stereo pairs to files of depth.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/parallel.h"
#include "io/calibrations/calibration_writer.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "stereo/rectification/rectifier.h"
#include "support/data_folder.h"
#include "support/in_folder.h"
#include "support/scene.h"
#include "tests/io/temporary_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// Of a pair of images.
MeasureOptions ofPair(const std::string& left, const std::string& right, const std::string& out) {
  MeasureOptions options;
  options.sequence.left = left;
  options.sequence.right = right;
  options.name = left;
  options.inputs = {{"left", left}, {"right", right}};
  options.out = out;
  return options;
}

Json measured(const MeasureOptions& options) { return written(measureSequence(options).record); }

class MeasuredDepth : public InFolder {
 protected:
  MeasureOptions options(const std::string& sequence, const std::string& out = "out") const {
    return measurement(sequence, at(out));
  }
};

const std::vector<std::string> kFiles{"disparity.pfm", "disparity.png",  "depth.pfm",
                                      "depth.png",     "confidence.png", "cloud.ply",
                                      "picture.png",   "summary.json"};

Json parsed(const fs::path& file) { return Json::parse(textOf(file)); }

/// Share of measured pixels within 0.7 mm of the slope that the sequence shows: a fifth of a pixel
/// here (f 140 px, baseline 5 mm: at 50 mm, 1 px of disparity is 3.6 mm of depth).
double shareNearTruth(const Raster<float>& depth_mm) {
  const Scene scene = makeScene(sequenceRig(), plane(50, 0.2, 0.1));
  int near = 0, measured = 0;
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    if (!std::isfinite(depth_mm.values[i])) continue;
    ++measured;
    near += std::abs(depth_mm.values[i] - scene.depth_mm.values[i]) < 0.7;
  }
  return measured == 0 ? 0 : double(near) / measured;
}

TEST_F(MeasuredDepth, APairGivesEveryFile) {
  const std::string sequence = makeSequence("s", 1);
  MeasureOptions options =
      ofPair(sequence + "/left/000000.png", sequence + "/right/000000.png", at("out"));
  options.sequence.calibration = sequence + "/calibration.yaml";
  const Json json = measured(options);
  for (const std::string& file : kFiles) EXPECT_TRUE(fs::exists(at("out/" + file))) << file;
  EXPECT_EQ(countFiles(at("out")), int(kFiles.size())) << "temporary files stayed";

  EXPECT_EQ(json, parsed(at("out/summary.json")));
  EXPECT_EQ(json["frames_done"], 1);
  EXPECT_EQ(json["backend"], "cpu") << "auto, for a single pair";
  EXPECT_GT(json["mean_coverage"], 0.7);  // the left rim has no partner in the right picture
  EXPECT_NEAR(json["frames"][0]["depth_mm"]["median"], 50, 1);
  EXPECT_TRUE(json["options"].contains("stereo.elas.coarser_levels"));
}

TEST_F(MeasuredDepth, FilesAgreeWithEachOtherAndWithTheScene) {
  const std::string sequence = makeSequence("s", 1);
  measureSequence(options(sequence));
  const Raster<float> depth_mm = readDepth(at("out/000000_depth.pfm"));
  const Raster<float> coarse_mm = readDepth(at("out/000000_depth.png"));
  const Raster<float> disparity_px = readDisparity(at("out/000000_disparity.png"));
  const GrayImage confidence = readGrayImage(at("out/000000_confidence.png"));
  EXPECT_GT(shareNearTruth(depth_mm), 0.95);
  const RectifiedRig rig = sequenceRig();
  for (std::size_t i = 0; i < depth_mm.size(); ++i) {
    ASSERT_EQ(std::isnan(depth_mm.values[i]), std::isnan(coarse_mm.values[i]));
    ASSERT_EQ(std::isnan(depth_mm.values[i]), confidence.values[i] == 0) << i;
    if (std::isnan(depth_mm.values[i])) continue;
    ASSERT_NEAR(depth_mm.values[i], coarse_mm.values[i], 0.0051);  // half a step of the file
    ASSERT_NEAR(rig.disparityPx(depth_mm.values[i]), disparity_px.values[i], 0.0021);  // 1/512 px
  }
}

TEST_F(MeasuredDepth, TheCloudIsAPlyOfAsManyPointsAsTheSummarySays) {
  const std::string sequence = makeSequence("s", 1);
  const Json json = measured(options(sequence));
  std::ifstream file(at("out/000000_cloud.ply"), std::ios::binary);
  const std::string head(2000, '\0');
  file.read(const_cast<char*>(head.data()), 2000);
  EXPECT_THAT(head, testing::StartsWith("ply\nformat binary_little_endian"));
  const int points = json["frames"][0]["points"];
  EXPECT_THAT(head, HasSubstr("element vertex " + std::to_string(points) + "\n"));
  EXPECT_GT(points, 10000);  // of 19200 pixels
}

/// Points of a PLY as `depth` writes it: six floats and three bytes each.
std::vector<Eigen::Vector3f> pointsOf(const std::string& ply) {
  std::ostringstream bytes;
  bytes << std::ifstream(ply, std::ios::binary).rdbuf();
  const std::string all = bytes.str(), end = "end_header\n";
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = all.find(end) + end.size(); i + 27 <= all.size(); i += 27) {
    points.emplace_back();
    std::memcpy(points.back().data(), all.data() + i, 12);
  }
  return points;
}

TEST_F(MeasuredDepth, TheRawLeftFrameTurnsTheCloudBack) {
  const std::string sequence = makeSequence("s", 1);
  StereoCalibration raw;
  raw.left.pinhole = raw.right.pinhole = sequenceRig().left;
  raw.right_from_left.translation() = Eigen::Vector3d(-5, 0.3, 0);  // 3.4 degrees off the rows
  writeCalibration(at("raw.yaml"), raw);
  MeasureOptions left = options(sequence, "left"), raw_left = options(sequence, "raw");
  left.sequence.calibration = raw_left.sequence.calibration = at("raw.yaml");
  raw_left.raw_left = true;
  measureSequence(left);
  measureSequence(raw_left);
  const auto in_left = pointsOf(at("left/000000_cloud.ply"));
  const auto in_raw = pointsOf(at("raw/000000_cloud.ply"));
  ASSERT_EQ(in_left.size(), in_raw.size());
  ASSERT_GT(in_left.size(), 5000u);
  const Eigen::Matrix3f turn = Rectifier(raw).rig().rectified_from_raw_left.cast<float>();
  ASSERT_GT((turn - Eigen::Matrix3f::Identity()).norm(), 0.05);
  for (std::size_t i = 0; i < in_left.size(); ++i)
    ASSERT_LT((turn * in_raw[i] - in_left[i]).norm(), 1e-4) << i;  // floats near 50 mm
  EXPECT_EQ(parsed(at("raw/summary.json"))["cloud_frame"], "raw left");
}

TEST_F(MeasuredDepth, NothingIsOverwrittenUnlessAskedTo) {
  const std::string sequence = makeSequence("s", 1);
  write("out/000000_cloud.ply", "mine");
  MeasureOptions over = options(sequence);
  expectError<OptionError>([&] { measureSequence(over); }, {"000000_cloud.ply", "`overwrite=`"});
  EXPECT_EQ(countFiles(at("out")), 1) << "something was written before the refusal";
  EXPECT_EQ(fs::file_size(at("out/000000_cloud.ply")), 4u);
  over.overwrite = true;
  measureSequence(over);
  EXPECT_GT(fs::file_size(at("out/000000_cloud.ply")), 1000u);
}

TEST_F(MeasuredDepth, OnlyWhatIsAskedForIsWritten) {
  const std::string sequence = makeSequence("s", 1);
  MeasureOptions picture = options(sequence);
  picture.kinds = DepthOutputKinds::parse("picture");
  measureSequence(picture);
  EXPECT_EQ(countFiles(at("out")), 2);  // and the summary
}

TEST_F(MeasuredDepth, OfSeveralFramesOnlyDepthUnlessMoreIsAskedFor) {
  const std::string sequence = makeSequence("s", 3);
  MeasureOptions every_second = options(sequence);
  every_second.settings.sequence.frames = parseFrameRange("0:3:2");
  const MeasuredSequence found = measureSequence(every_second);
  EXPECT_EQ(countFiles(at("out")), 3) << "two maps and the summary";
  EXPECT_TRUE(fs::exists(at("out/000002_depth.png"))) << "under its own number";
  EXPECT_THAT(found.files,
              testing::Contains(HasSubstr("depth.png of each of 2 frames; summary.json")));
  MeasureOptions more = options(sequence, "more");
  more.kinds = DepthOutputKinds::parse("disparity,cloud");
  measureSequence(more);
  EXPECT_EQ(countFiles(at("more")), 3 * 3 + 1);
}

TEST_F(MeasuredDepth, DisparityNeedsNoCalibration) {
  const std::string sequence = makeSequence("s", 1);
  const std::string left = sequence + "/left/000000.png", right = sequence + "/right/000000.png";
  MeasureOptions pair = ofPair(left, right, at("out")), with = options(sequence, "with");
  pair.kinds = with.kinds = DepthOutputKinds::parse("disparity");
  const MeasuredSequence found = measureSequence(pair);
  measureSequence(with);
  EXPECT_TRUE(textOf(at("out/disparity.pfm")) == textOf(at("with/000000_disparity.pfm")))
      << "the same, for the pair is rectified";
  EXPECT_THAT(found.facts.text(), testing::Not(HasSubstr(" mm")))
      << "no lengths without a calibration";
  const Json summary = parsed(at("out/summary.json"));
  EXPECT_TRUE(summary["calibration"].is_null());
  EXPECT_TRUE(summary["frames"][0]["depth_mm"].is_null());
}

TEST_F(MeasuredDepth, ABadFrameIsReportedAndSkipped) {
  const std::string sequence = makeSequence("s", 3);
  fs::resize_file(sequence + "/right/000001.png", 500);
  Told told;
  const Json json = written(measureSequence(options(sequence), told.listener()).record);
  EXPECT_THAT(told.failures, ElementsAre(HasSubstr("000001.png")));
  EXPECT_EQ(json["frames_done"], 2);
  EXPECT_EQ(json["failed"][0]["frame"], 1);
  EXPECT_TRUE(fs::exists(at("out/000002_depth.png")));
  EXPECT_FALSE(fs::exists(at("out/000001_depth.png")));
}

TEST_F(MeasuredDepth, WarningsComeOnceWithACount) {
  const std::string sequence = makeSequence("s", 5);
  for (const char* frame : {"1", "2", "4"})
    fs::resize_file(sequence + "/right/00000" + frame + ".png", 500);
  Told told;
  const Json json = written(measureSequence(options(sequence), told.listener()).record);
  EXPECT_THAT(told.failures,
              ElementsAre(HasSubstr("000001.png"),
                          HasSubstr("not measured: 2 more frames, 2 to 4; details: summary.json")));
  EXPECT_THAT(told.warnings, testing::IsEmpty());
  EXPECT_EQ(json["failed"].size(), 3u);
}

TEST_F(MeasuredDepth, BadInputIsRefusedAndLeavesNothing) {
  const std::string good = makeSequence("good", 1);
  const std::string truncated = makeSequence("truncated", 1);
  fs::resize_file(truncated + "/left/000000.png", 300);
  const std::string unequal = makeSequence("unequal", 2);
  fs::remove(unequal + "/right/000001.png");
  const std::string other_size = makeSequence("other_size", 1);
  writePng(other_size + "/left/000000.png", ColourImage(64, 48), true);
  writePng(other_size + "/right/000000.png", ColourImage(64, 48), true);
  const std::string metres = makeSequence("metres", 1);
  StereoCalibration calibration;
  calibration.left.pinhole = calibration.right.pinhole = sequenceRig().left;
  calibration.right_from_left.translation().x() = -0.005;
  calibration.rectified = true;
  writeCalibration(metres + "/calibration.yaml", calibration, true);
  const std::string loop = makeSequence("loop", 1);
  fs::remove(loop + "/left/000000.png");
  fs::create_symlink("000000.png", loop + "/left/000000.png");

  for (const std::string& sequence :
       {at("absent"), truncated, unequal, other_size, metres, loop, at("good/left")}) {
    SCOPED_TRACE(sequence);
    expectError<InputError>([&] { measureSequence(options(sequence)); }, {});
    EXPECT_FALSE(fs::exists(at("out")));
  }
  MeasureOptions no_image = ofPair({}, {}, at("out"));
  no_image.sequence.stereo = no_image.sequence.calibration = good + "/calibration.yaml";
  expectError<InputError>([&] { measureSequence(no_image); }, {"calibration.yaml"});
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(MeasuredDepth, MaskedPixelsAreLeftOut) {
  const std::string sequence = makeSequence("s", 1);
  GrayImage mask(160, 120);
  for (int v = 0; v < 60; ++v) std::fill_n(mask.row(v), 160, std::uint8_t(255));
  writePng(at("mask.png"), mask);
  MeasureOptions masked = options(sequence);
  masked.sequence.mask = at("mask.png");
  measureSequence(masked);
  const Raster<float> depth_mm = readDepth(at("out/000000_depth.pfm"));
  for (int u = 0; u < 160; ++u) EXPECT_TRUE(std::isnan(depth_mm.at(u, 30)));
  EXPECT_FALSE(std::isnan(depth_mm.at(100, 90)));
}

TEST_F(MeasuredDepth, DepthFilesMayReplaceStereo) {
  const std::string sequence = makeSequence("s", 1);
  fs::create_directories(sequence + "/depth");
  writeDepthPng(sequence + "/depth/000000.png", Raster<float>(160, 120, 42.5f));
  for (const char* source : {"auto", "files"}) {
    MeasureOptions of_source = options(sequence, source);
    set({std::string("depth.source=") + source}, &of_source.settings);
    const Json json = measured(of_source);
    EXPECT_EQ(json["method"], "files") << source;
    EXPECT_DOUBLE_EQ(json["frames"][0]["depth_mm"]["median"], 42.5) << source;
    EXPECT_FALSE(fs::exists(at(std::string(source) + "/000000_disparity.png"))) << source;
  }
  MeasureOptions stereo = options(sequence);
  set({"depth.source=stereo"}, &stereo.settings);
  EXPECT_EQ(measured(stereo)["method"], "elas");
}

TEST_F(MeasuredDepth, BothViewsInOnePictureAreParted) {
  const std::string sequence = makeSequence("s", 1);
  const ColourImage left = readColourImage(sequence + "/left/000000.png");
  const ColourImage right = readColourImage(sequence + "/right/000000.png");
  ColourImage both(320, 120);
  for (int v = 0; v < 120; ++v) {
    std::copy_n(left.row(v), 160, both.row(v));
    std::copy_n(right.row(v), 160, both.row(v) + 160);
  }
  writePng(at("both.png"), both);
  MeasureOptions parted = ofPair({}, {}, at("out"));
  parted.sequence.stereo = at("both.png");
  parted.sequence.calibration = sequence + "/calibration.yaml";
  EXPECT_NEAR(measured(parted)["frames"][0]["depth_mm"]["median"], 50, 1);
}

TEST_F(MeasuredDepth, OneThreadGivesTheSameBytes) {
  const std::string sequence = makeSequence("s", 1);
  measureSequence(options(sequence, "all"));
  {
    const ThreadLimit one(1);
    measureSequence(options(sequence, "one"));
  }
  for (const char* name : {"disparity.pfm", "confidence.png", "cloud.ply", "picture.png"})
    EXPECT_TRUE(textOf(at(std::string("all/000000_") + name)) ==
                textOf(at(std::string("one/000000_") + name)))
        << name;
}

TEST_F(MeasuredDepth, ARawPairIsRectifiedInside) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  MeasureOptions raw = ofPair(data / "left.png", data / "right.png", at("out"));
  raw.sequence.calibration = data;
  raw.raw_left = true;
  const Json json = measured(raw);
  EXPECT_FALSE(json["calibration"]["rectified"]);
  EXPECT_GT(json["mean_coverage"], 0.3);
  EXPECT_GT(json["frames"][0]["depth_mm"]["median"], 30);  // the tissue lies some 40 to 90 mm away
  EXPECT_LT(json["frames"][0]["depth_mm"]["median"], 120);
}

}  // namespace
}  // namespace softscope::test
