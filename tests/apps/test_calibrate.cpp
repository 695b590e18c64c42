// tests/apps/test_calibrate.cpp: `softscope calibrate` from rendered films to a calibration.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "calibrate/rendered_boards.h"
#include "io/calibrations/calibration_reader.h"
#include "io/files/folder.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Calibrate : public InFolder {
 protected:
  static BoardRendering rendering() {
    BoardRendering rendering;
    rendering.truth = truthOfScope(0.6);
    rendering.board.square_mm = 3;
    rendering.seed = 5;
    static const auto rays = raysOfScope(rendering.truth);
    rendering.rays = rays;
    return rendering;
  }

  void write(int frame, const GrayImage& left, const GrayImage& right) const {
    writePng(at("left/" + numberedName(frame, ".png")), left);
    writePng(at("right/" + numberedName(frame, ".png")), right);
  }

  /// `views` sharp ones, then one that is blurred and one that repeats the first.
  void film(int views) const {
    fs::create_directories(at("left"));
    fs::create_directories(at("right"));
    BoardRendering r = rendering();
    const auto poses = boardPoses(r, std::max(views, 5));
    for (int i = 0; i < views; ++i)
      write(i, renderBoard(r, poses[std::size_t(i)], false, 2 * i),
            renderBoard(r, poses[std::size_t(i)], true, 2 * i + 1));
    write(views + 1, renderBoard(r, poses[0], false, 901), renderBoard(r, poses[0], true, 902));
    r.blur_px = 2.6;
    write(views, renderBoard(r, poses[4], false, 903), renderBoard(r, poses[4], true, 904));
  }

  std::vector<std::string> words(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"calibrate", at("left"), at("right"), "--board",    "9x6",
                                   "--square",  "3",        "--out",     at("c.yaml"), "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(Calibrate, FilmsGiveACalibrationThatOtherCommandsRead) {
  film(14);
  const Outcome outcome = run(words({"--json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = outcome.json();
  EXPECT_GE(json["views_used"], 12);
  EXPECT_LT(json["rms_px"], 0.2);
  EXPECT_GT(json["coverage"]["left"], 0.5);
  EXPECT_GT(json["row_error"]["expected_median_95_px"], 0);
  EXPECT_GT(json["row_error"]["expected_worst_95_px"], json["row_error"]["expected_median_95_px"]);
  ASSERT_EQ(json["depth"].size(), 3u);
  EXPECT_GT(json["depth"][2]["sigma_mm"], json["depth"][0]["sigma_mm"]);
  bool blurred = false, doubled = false;
  for (const auto& view : json["views"]["left_out"]) {
    blurred |= view["frame"] == 14 && view["why"].get<std::string>().find("blurred") == 0;
    doubled |= (view["frame"] == 15 || view["frame"] == 0) &&
               view["why"].get<std::string>().find("doubled") == 0;
  }
  EXPECT_TRUE(blurred && doubled) << json["views"]["left_out"];

  const StereoCalibration found = readCalibration(at("c.yaml")), truth = rendering().truth;
  EXPECT_NEAR(found.left.pinhole.fx_px / truth.left.pinhole.fx_px, 1, 0.005);  // small images
  EXPECT_NEAR(found.baseline_mm() / truth.baseline_mm(), 1, 0.005);
  EXPECT_EQ(found.left.pinhole.width_px, truth.left.pinhole.width_px);
  EXPECT_THAT(textOf(at("c.yaml")), HasSubstr("left_fx_px_half_width_95"));
  EXPECT_THAT(textOf(at("c.yaml")), HasSubstr("row_error_worst_95_px"));
  EXPECT_EQ(run({"info", at("c.yaml"), "--json"}).exit_code, 0);
  const ColourImage picture = readColourImage(at("c_coverage.png"));
  EXPECT_EQ(picture.height_px, truth.left.pinhole.height_px);

  const Outcome again = run(words());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  EXPECT_EQ(run(words({"--force"})).exit_code, 0);
}

TEST_F(Calibrate, BothViewsInOneImageGiveTheSame) {
  film(8);
  fs::create_directories(at("stereo"));
  for (int i = 0; i < 8; ++i) {
    const std::string name = numberedName(i, ".png");
    const GrayImage left = readGrayImage(at("left/" + name)),
                    right = readGrayImage(at("right/" + name));
    GrayImage both(left.width_px, 2 * left.height_px);
    std::copy(left.values.begin(), left.values.end(), both.values.begin());
    std::copy(right.values.begin(), right.values.end(), both.row(left.height_px));
    writePng(at("stereo/" + name), both);
  }
  const Outcome outcome =
      run({"calibrate", at("stereo"), "--layout", "top-bottom", "--board", "9x6", "--square", "3",
           "--out", at("stacked.yaml"), "--json", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("more views"));  // what to film: 8 are few
  EXPECT_EQ(outcome.json()["image_px"][1], 288);
}

TEST_F(Calibrate, RefineWritesACalibrationAndTakesNoBoard) {
  ASSERT_EQ(run({"simulate", "--out", at("clip"), "--frames", "2", "--size", "320x240", "--quiet"})
                .exit_code,
            0);
  const std::string given = at("clip/calibration.yaml");
  const Outcome outcome = run({"calibrate", at("clip"), "--refine", given, "--out",
                               at("refined.yaml"), "--json", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["frames"], 2);
  EXPECT_NEAR(readCalibration(at("refined.yaml")).baseline_mm(),
              readCalibration(given).baseline_mm(), 1e-9);
  const Outcome both = run({"calibrate", at("clip"), "--refine", given, "--board", "9x6", "--out",
                            at("x.yaml"), "--quiet"});
  EXPECT_EQ(both.exit_code, 2);
  const Outcome none = run({"calibrate", at("clip"), "--out", at("x.yaml"), "--quiet"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("--board and --square are needed"));
}

TEST_F(Calibrate, WhatCannotBeIsOneLine) {
  film(3);
  const auto fails = [&](std::vector<std::string> arguments, int code, const std::string& text) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(at("c.yaml")));
  };
  auto with = [&](std::size_t place, const std::string& word) {
    auto arguments = words();
    arguments[place] = word;
    return arguments;
  };
  fails(with(4, "8x5"), 3, "Is --board right");
  fails(with(4, "9"), 2, "--board is 9, but must be COLUMNSxROWS");
  fails(with(4, ""), 2, "--board CxR, e.g. 9x6, is missing");
  fails(with(4, "2x6"), 2, "--board: columns is 2, but a board has 3 to 60");
  fails({"calibrate", at("left"), at("right"), "--out", at("c.yaml"), "--board"}, 2,
        "--board has no value: inner corners of a checkerboard");
  fails({"calibrate", at("left"), at("right"), "--out", at("c.yaml"), "--board", "--square", "3"},
        2, "--board has no value, `--square` follows");
  fails({"calibrate", at("left"), at("right"), "--out", at("c.yaml"), "--board", "9x6"}, 2,
        "--square MM is missing");
  fails(with(4, "9x0.5"), 2, "--board");
  fails(with(4, "6x6"), 2, "by rotations of 90");
  fails(with(6, "0"), 2, "--square");
  fails(with(1, at("nowhere")), 3, "nowhere");
  fails(words({"--lens", "3"}), 2, "--lens is 3");
  fails(words({"--marker", "2", "--dictionary", "none"}), 2, "4X4_50");
  fails(words({"--distances", "50,far"}), 2, "--distances");
  fails(words({"--layout", "top-bottom"}), 2, "leave RIGHT out");
  fs::remove(at("right/000001.png"));
  fails(words(), 3, "000001");
}

}  // namespace
}  // namespace softscope::test
