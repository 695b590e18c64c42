// tests/apps/test_depth.cpp: `softscope depth`: its options, its lines and its exit codes.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "io/images/image_writer.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Depth : public InFolder {};

nlohmann::json parsed(const fs::path& file) { return nlohmann::json::parse(textOf(file)); }

TEST_F(Depth, OptionsReachTheFiles) {
  const std::string sequence = makeSequence("s", 1);
  GrayImage mask(160, 120);
  for (int v = 0; v < 60; ++v) std::fill_n(mask.row(v), 160, std::uint8_t(255));
  writePng(at("mask.png"), mask);
  const Outcome outcome =
      run({"depth", sequence + "/left/000000.png", sequence + "/right/000000.png", "--calibration",
           sequence + "/calibration.yaml", "--mask", at("mask.png"), "--frame", "raw-left",
           "--range", "40:80", "--dense", "--threads", "1", "--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json, parsed(at("out/summary.json")));
  EXPECT_EQ(json["cloud_frame"], "raw left");
  EXPECT_EQ(json["inputs"]["mask"], "mask.png");
  EXPECT_TRUE(fs::exists(at("out/dense.pfm")));
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

TEST_F(Depth, NothingIsOverwrittenWithoutForce) {
  const std::string sequence = makeSequence("s", 1);
  write("out/000000_cloud.ply", "mine");
  const Outcome refused = run({"depth", sequence, "--out", at("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(countFiles(at("out")), 1) << "something was written before the refusal";
  EXPECT_EQ(run({"depth", sequence, "--out", at("out"), "--force"}).exit_code, 0);
}

TEST_F(Depth, LinesTellWhatWasWrittenAndHowToGetMore) {
  const std::string sequence = makeSequence("s", 3);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--frames", "0:3:2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("depth.png of each of 2 frames; summary.json"));
  EXPECT_THAT(outcome.out, HasSubstr("--write disparity,depth,confidence,cloud,picture"));
  ASSERT_EQ(run({"depth", sequence, "--out", at("more"), "--write", "disparity,cloud"}).exit_code,
            0);
  EXPECT_EQ(countFiles(at("more")), 3 * 3 + 1);
}

TEST_F(Depth, DisparityNeedsNoCalibration) {
  const std::string sequence = makeSequence("s", 1);
  const std::string left = sequence + "/left/000000.png", right = sequence + "/right/000000.png";
  const Outcome outcome = run({"depth", left, right, "--out", at("out"), "--write", "disparity"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr(" mm"))) << "no lengths without a calibration";
  EXPECT_EQ(run({"depth", left, right, "--out", at("no"), "--write", "disparity,depth"}).exit_code,
            2);
}

TEST_F(Depth, ABadFrameIsOneLineAndTheOthersGoOn) {
  const std::string sequence = makeSequence("s", 5);
  for (const char* frame : {"1", "2", "4"})
    fs::resize_file(sequence + "/right/00000" + frame + ".png", 500);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("000001.png"));
  EXPECT_THAT(outcome.err, HasSubstr("not measured: 2 more frames, 2 to 4; details: summary.json"));
  EXPECT_EQ(outcome.json()["frames_done"], 2);
}

TEST_F(Depth, BadInputIsExitCodeThreeAndLeavesNothing) {
  const std::string good = makeSequence("good", 1);
  const std::string unequal = makeSequence("unequal", 2);
  fs::remove(unequal + "/right/000001.png");
  for (const std::string& sequence :
       {at("absent"), unequal, at("good/left"), at("good/calibration.yaml")}) {
    std::vector<std::string> line{"depth", sequence, "--out", at("out")};
    if (!fs::is_directory(sequence))
      line.insert(line.end(), {"--calibration", good + "/calibration.yaml"});
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exit_code, 3) << sequence << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(at("out"))) << sequence;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(Depth, QuietSaysNothingWhenAllIsWell) {
  const std::string sequence = makeSequence("s", 1);
  const Outcome outcome = run({"depth", sequence, "--out", at("out"), "--quiet"});
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("coverage"));
}

TEST_F(Depth, ABadNetworkIsOneLineAndExitCode3) {
  const std::string sequence = makeSequence("s", 2), model = write("text.onnx", "a network");
  for (const char* command : {"depth", "reconstruct"}) {
    const Outcome outcome = run({command, sequence, "--out", at("out"), "--quiet", "--set",
                                 "stereo.method=onnx", "--set", "stereo.model=" + model});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("text.onnx: isn't an ONNX model")) << command;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(at("out"))) << command;
  }
  const Outcome alone = run({"depth", sequence, "--out", at("out"), "--set", "stereo.method=onnx"});
  EXPECT_EQ(alone.exit_code, 2) << alone.err;
  EXPECT_THAT(alone.err, HasSubstr("stereo.model=FILE.onnx"));
}

}  // namespace
}  // namespace softscope::test
