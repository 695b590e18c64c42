// tests/apps/test_depth.cpp: `softscope depth` from files to files.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "io/calibrations/calibration_writer.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "stereo/rectification/rectifier.h"
#include "support/data_folder.h"
#include "support/onnx_network.h"
#include "support/scene.h"
#include "tests/apps/run_softscope.h"
#include "vtk_views/plots/depth_picture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Depth : public InFolder {};

const std::vector<std::string> kFiles{"disparity.pfm", "disparity.png",  "depth.pfm",
                                      "depth.png",     "confidence.png", "cloud.ply",
                                      "picture.png",   "summary.json"};

nlohmann::json parsed(const fs::path& file) { return nlohmann::json::parse(std::ifstream(file)); }

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

TEST_F(Depth, APairGivesEveryFile) {
  const std::string sequence = makeSequence("s", 1);
  const Outcome outcome =
      run({"depth", sequence + "/left/000000.png", sequence + "/right/000000.png", "--calibration",
           sequence + "/calibration.yaml", "--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const std::string& file : kFiles) EXPECT_TRUE(fs::exists(at("out/" + file))) << file;
  EXPECT_EQ(countFiles(at("out")), int(kFiles.size())) << "temporary files stayed";

  const auto json = outcome.json();
  EXPECT_EQ(json, parsed(at("out/summary.json")));
  EXPECT_EQ(json["frames_done"], 1);
  EXPECT_EQ(json["backend"], "cpu") << "auto, for a single pair";
  EXPECT_GT(json["mean_coverage"], 0.7);  // the left rim has no partner in the right picture
  EXPECT_NEAR(json["frames"][0]["depth_mm"]["median"], 50, 1);
  EXPECT_TRUE(json["options"].contains("stereo.elas.coarser_levels"));
}

TEST_F(Depth, FilesAgreeWithEachOtherAndWithTheScene) {
  const std::string sequence = makeSequence("s", 1);
  ASSERT_EQ(run({"depth", sequence, "--out", at("out")}).exit_code, 0);
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

TEST_F(Depth, TheCloudIsAPlyOfAsManyPointsAsTheSummarySays) {
  const std::string sequence = makeSequence("s", 1);
  const auto json = run({"depth", sequence, "--out", at("out"), "--json"}).json();
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

TEST_F(Depth, TheRawLeftFrameTurnsTheCloudBack) {
  const std::string sequence = makeSequence("s", 1);
  StereoCalibration raw;
  raw.left.pinhole = raw.right.pinhole = sequenceRig().left;
  raw.right_from_left.translation() = Eigen::Vector3d(-5, 0.3, 0);  // 3.4 degrees off the rows
  writeCalibration(at("raw.yaml"), raw);
  const std::vector<std::string> line{"depth", sequence, "--calibration", at("raw.yaml"), "--out"};
  std::vector<std::string> left = line, raw_left = line;
  left.push_back(at("left"));
  raw_left.insert(raw_left.end(), {at("raw"), "--frame", "raw-left"});
  ASSERT_EQ(run(left).exit_code, 0);
  ASSERT_EQ(run(raw_left).exit_code, 0);
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

TEST_F(Depth, NothingIsOverwrittenWithoutForce) {
  const std::string sequence = makeSequence("s", 1);
  write("out/000000_cloud.ply", "mine");
  const Outcome refused = run({"depth", sequence, "--out", at("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(countFiles(at("out")), 1) << "something was written before the refusal";
  EXPECT_EQ(fs::file_size(at("out/000000_cloud.ply")), 4u);
  EXPECT_EQ(run({"depth", sequence, "--out", at("out"), "--force"}).exit_code, 0);
  EXPECT_GT(fs::file_size(at("out/000000_cloud.ply")), 1000u);
}

TEST_F(Depth, OnlyWhatIsAskedForIsWritten) {
  const std::string sequence = makeSequence("s", 1);
  ASSERT_EQ(run({"depth", sequence, "--out", at("out"), "--write", "picture"}).exit_code, 0);
  EXPECT_EQ(countFiles(at("out")), 2);  // and the summary
}

TEST_F(Depth, OfSeveralFramesOnlyDepthUnlessMoreIsAskedFor) {
  const std::string sequence = makeSequence("s", 3);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--frames", "0:3:2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(countFiles(at("out")), 3) << "two maps and the summary";
  EXPECT_TRUE(fs::exists(at("out/000002_depth.png"))) << "under its own number";
  EXPECT_THAT(outcome.out, HasSubstr("depth.png of each of 2 frames; summary.json"));
  EXPECT_THAT(outcome.out, HasSubstr("--write disparity,depth,confidence,cloud,picture"));
  const Outcome more = run({"depth", sequence, "--out", at("more"), "--write", "disparity,cloud"});
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_EQ(countFiles(at("more")), 3 * 3 + 1);
}

TEST_F(Depth, DisparityNeedsNoCalibration) {
  const std::string sequence = makeSequence("s", 1);
  const std::string left = sequence + "/left/000000.png", right = sequence + "/right/000000.png";
  const Outcome outcome = run({"depth", left, right, "--out", at("out"), "--write", "disparity"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(run({"depth", sequence, "--out", at("with"), "--write", "disparity"}).exit_code, 0);
  EXPECT_TRUE(textOf(at("out/disparity.pfm")) == textOf(at("with/000000_disparity.pfm")))
      << "the same, for the pair is rectified";
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr(" mm"))) << "no lengths without a calibration";
  const auto summary = parsed(at("out/summary.json"));
  EXPECT_TRUE(summary["calibration"].is_null());
  EXPECT_TRUE(summary["frames"][0]["depth_mm"].is_null());
  EXPECT_EQ(run({"depth", left, right, "--out", at("no"), "--write", "disparity,depth"}).exit_code,
            2);
}

TEST_F(Depth, ABadFrameIsReportedAndSkipped) {
  const std::string sequence = makeSequence("s", 3);
  fs::resize_file(sequence + "/right/000001.png", 500);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("000001.png"));
  const auto json = outcome.json();
  EXPECT_EQ(json["frames_done"], 2);
  EXPECT_EQ(json["failed"][0]["frame"], 1);
  EXPECT_TRUE(fs::exists(at("out/000002_depth.png")));
  EXPECT_FALSE(fs::exists(at("out/000001_depth.png")));
}

TEST_F(Depth, WarningsComeOnceWithACount) {
  const std::string sequence = makeSequence("s", 5);
  for (const char* frame : {"1", "2", "4"})
    fs::resize_file(sequence + "/right/00000" + frame + ".png", 500);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("000001.png"));
  EXPECT_THAT(outcome.err, HasSubstr("not measured: 2 more frames, 2 to 4; summary.json has each"));
  EXPECT_EQ(outcome.json()["failed"].size(), 3u);
}

TEST_F(Depth, BadInputIsExitCodeThreeAndLeavesNothing) {
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

  for (const std::string& sequence : {at("absent"), truncated, unequal, other_size, metres, loop,
                                      at("good/left"), at("good/calibration.yaml")}) {
    std::vector<std::string> line{"depth", sequence, "--out", at("out")};
    if (!fs::is_directory(sequence)) {
      line.insert(line.end(), {"--calibration", good + "/calibration.yaml"});
    }
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exit_code, 3) << sequence << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(at("out"))) << sequence;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(Depth, SettingsComeFromFileAndLine) {
  const std::string sequence = makeSequence("s", 1);
  const std::string config =
      write("c.toml", "[stereo]\nmethod = \"sgbm\"\ndisparity_max_px = 63\n");
  const auto json = run({"depth", sequence, "--out", at("out"), "--config", config, "--set",
                         "stereo.disparity_max_px=47", "--json"})
                        .json();
  EXPECT_EQ(json["method"], "sgbm");
  EXPECT_EQ(json["options"]["stereo.disparity_max_px"], 47);
}

TEST_F(Depth, MaskedPixelsAreLeftOut) {
  const std::string sequence = makeSequence("s", 1);
  GrayImage mask(160, 120);
  for (int v = 0; v < 60; ++v) std::fill_n(mask.row(v), 160, std::uint8_t(255));
  writePng(at("mask.png"), mask);
  ASSERT_EQ(run({"depth", sequence, "--out", at("out"), "--mask", at("mask.png")}).exit_code, 0);
  const Raster<float> depth_mm = readDepth(at("out/000000_depth.pfm"));
  for (int u = 0; u < 160; ++u) EXPECT_TRUE(std::isnan(depth_mm.at(u, 30)));
  EXPECT_FALSE(std::isnan(depth_mm.at(100, 90)));
}

TEST_F(Depth, DepthFilesMayReplaceStereo) {
  const std::string sequence = makeSequence("s", 1);
  fs::create_directories(sequence + "/depth");
  writeDepthPng(sequence + "/depth/000000.png", Raster<float>(160, 120, 42.5f));
  for (const char* source : {"auto", "files"}) {
    const auto json = run({"depth", sequence, "--out", at(source), "--set",
                           std::string("depth.source=") + source, "--json"})
                          .json();
    EXPECT_EQ(json["method"], "files") << source;
    EXPECT_DOUBLE_EQ(json["frames"][0]["depth_mm"]["median"], 42.5) << source;
    EXPECT_FALSE(fs::exists(at(std::string(source) + "/000000_disparity.png"))) << source;
  }
  const auto stereo =
      run({"depth", sequence, "--out", at("out"), "--set", "depth.source=stereo", "--json"}).json();
  EXPECT_EQ(stereo["method"], "elas");
}

TEST_F(Depth, BothViewsInOnePictureAreParted) {
  const std::string sequence = makeSequence("s", 1);
  const ColourImage left = readColourImage(sequence + "/left/000000.png");
  const ColourImage right = readColourImage(sequence + "/right/000000.png");
  ColourImage both(320, 120);
  for (int v = 0; v < 120; ++v) {
    std::copy_n(left.row(v), 160, both.row(v));
    std::copy_n(right.row(v), 160, both.row(v) + 160);
  }
  writePng(at("both.png"), both);
  const Outcome outcome = run({"depth", at("both.png"), "--calibration",
                               sequence + "/calibration.yaml", "--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(outcome.json()["frames"][0]["depth_mm"]["median"], 50, 1);
}

TEST_F(Depth, QuietSaysNothingWhenAllIsWell) {
  const std::string sequence = makeSequence("s", 1);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--quiet"});
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("coverage"));
}

TEST_F(Depth, OneThreadGivesTheSameBytes) {
  const std::string sequence = makeSequence("s", 1);
  ASSERT_EQ(run({"depth", sequence, "--out", at("all")}).exit_code, 0);
  ASSERT_EQ(run({"depth", sequence, "--out", at("one"), "--threads", "1"}).exit_code, 0);
  for (const char* name : {"disparity.pfm", "confidence.png", "cloud.ply", "picture.png"}) {
    std::ostringstream all, one;
    all << std::ifstream(at(std::string("all/000000_") + name), std::ios::binary).rdbuf();
    one << std::ifstream(at(std::string("one/000000_") + name), std::ios::binary).rdbuf();
    EXPECT_TRUE(all.str() == one.str()) << name;
  }
}

TEST_F(Depth, ARawPairIsRectifiedInside) {
  SOFTSCOPE_DATA_OR_SKIP(data, "opencas_ct");
  const Outcome outcome = run({"depth", data / "left.png", data / "right.png", "--calibration",
                               data, "--out", at("out"), "--frame", "raw-left", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_FALSE(json["calibration"]["rectified"]);
  EXPECT_GT(json["mean_coverage"], 0.3);
  EXPECT_GT(json["frames"][0]["depth_mm"]["median"], 30);  // the tissue lies some 40 to 90 mm away
  EXPECT_LT(json["frames"][0]["depth_mm"]["median"], 120);
}

// A fraction of a pixel at 14 px of disparity: 50 mm to a millimetre.
TEST_F(Depth, ANetworkMeasuresWhatElasDoes) {
  const std::string sequence = makeSequence("s", 1);
  PlaneSweep sweep;
  sweep.disparities = 24;
  sweep.window_px = 7;
  sweep.sharpness = 1;
  const std::string model = write("private/net.onnx", sweep.model());
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--set", "stereo.method=onnx",
                               "--set", "stereo.model=" + model, "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json["method"], "onnx");
  EXPECT_EQ(json["inputs"]["stereo_model"], "net.onnx");
  EXPECT_EQ(json["options"]["stereo.model"], "net.onnx") << "no path";
  EXPECT_GT(json["mean_coverage"], 0.7);
  EXPECT_NEAR(json["frames"][0]["depth_mm"]["median"], 50, 1);
}

TEST_F(Depth, ANetworkMeasuresTheRenderedHeart) {
  SOFTSCOPE_DATA_OR_SKIP(heart, "openhelp_heart");
  PlaneSweep sweep;
  sweep.disparities = 64;
  sweep.window_px = 11;
  sweep.channels = 1;
  const std::string model = write("net.onnx", sweep.model());
  const Outcome outcome =
      run({"depth", heart, "--frames", "0:1", "--out", at("out"), "--quiet", "--write", "depth",
           "--set", "stereo.method=onnx", "--set", "stereo.model=" + model});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Raster<float> found = readDepth(at("out/000000_depth.pfm"));
  const Raster<float> truth = readDepth(heart / "groundtruth/depth/000000.png");
  std::vector<double> errors_mm;
  std::size_t known = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    known += std::isfinite(truth.values[i]);
    const double error_mm = std::abs(found.values[i] - truth.values[i]);
    if (std::isfinite(error_mm)) errors_mm.push_back(error_mm);
  }
  EXPECT_GT(errors_mm.size(), 0.6 * known);
  const auto middle = errors_mm.begin() + long(errors_mm.size() / 2);
  std::nth_element(errors_mm.begin(), middle, errors_mm.end());
  RecordProperty("median_mm", std::to_string(*middle));
  RecordProperty("coverage", std::to_string(double(errors_mm.size()) / double(known)));
  EXPECT_LT(*middle, 0.4);  // a quarter of a pixel at 65 mm here
}

TEST_F(Depth, ABadNetworkIsOneLineAndExitCode3) {
  const std::string sequence = makeSequence("s", 2);
  const auto expect = [&](const std::string& model, const std::string& part) {
    for (const char* command : {"depth", "reconstruct"}) {
      const Outcome outcome = run({command, sequence, "--out", at("out"), "--quiet", "--set",
                                   "stereo.method=onnx", "--set", "stereo.model=" + model});
      EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(part)) << command;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      EXPECT_FALSE(fs::exists(at("out"))) << command;
    }
  };
  expect(at("none.onnx"), "none.onnx");
  expect(write("text.onnx", "a network"), "text.onnx: isn't an ONNX model");
  PlaneSweep lacking, zero;
  lacking.more = {"GridSample"};
  zero.output_factor = 0;
  expect(write("lacking.onnx", lacking.model()), "lacks operators of this network: GridSample");
  expect(write("zero.onnx", zero.model()), "its output disparity is 0 to 0");
  const Outcome alone = run({"depth", sequence, "--out", at("out"), "--set", "stereo.method=onnx"});
  EXPECT_EQ(alone.exit_code, 2) << alone.err;
  EXPECT_THAT(alone.err, HasSubstr("stereo.model=FILE.onnx"));
}

}  // namespace
}  // namespace softscope::test
