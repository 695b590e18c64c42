// tests/apps/test_simulate.cpp: `softscope simulate`: options, lines and exit codes.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "io/images/image_writer.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Frames of 64 x 48 of a coarse organ: a tenth of a second in all.
class Simulate : public InFolder {
 protected:
  Outcome simulate(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> line{"simulate", "--out", out};
    for (const char* setting : {"frames=3", "truth_every=2", "scope.width_px=64",
                                "scope.height_px=48", "organ.cells_per_side=10"})
      line.insert(line.end(), {"--set", setting});
    line.insert(line.end(), more.begin(), more.end());
    return run(line);
  }
  nlohmann::json optionsOf(const std::string& name) const {
    return nlohmann::json::parse(textOf(at(name + "/simulation.json")))["options"];
  }

  static void expectOneLine(const Outcome& outcome, int exit_code) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("error: "));
    EXPECT_EQ(outcome.out, "");
  }
};

TEST_F(Simulate, OptionsAreStrongerThanSettingsAndThoseThanAScenario) {
  writePng(at("blue.png"), ColourImage(64, 48, Rgb8{20, 40, 220}), false);
  const std::string scenario =
      write("scenario.toml", "frames = 9\nseed = 4\n[scope]\nbaseline_mm = 4.5\nwidth_px = 100\n");
  const Outcome outcome =
      simulate(at("s"), {"--scenario", scenario, "--size", "80x60", "--seed", "5", "--texture",
                         at("blue.png"), "--truth", "tracks", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["frames"], 3);
  EXPECT_EQ(outcome.json()["picture_px"], (nlohmann::json{80, 60}));
  const auto options = optionsOf("s");
  EXPECT_EQ(options["frames"], 3) << "--set";
  EXPECT_EQ(options["scope.baseline_mm"], 4.5) << "--scenario";
  EXPECT_EQ(options["scope.width_px"], 80) << "--size";
  EXPECT_EQ(options["seed"], 5) << "--seed";
  EXPECT_EQ(options["texture.picture"], at("blue.png"));
  EXPECT_EQ(countFiles(at("s/groundtruth")), 1) << "--truth";
}

TEST_F(Simulate, FlawsOfAnOrgansFileAreTold) {
  write("open.obj",
        "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");  // a face lacks
  const Outcome outcome = simulate(at("s"), {"--organ", at("open.obj")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("open.obj: left 1 holes open"));
  expectOneLine(simulate(at("t"), {"--organ", at("absent.stl")}), 3);
  EXPECT_FALSE(fs::exists(at("t")));
}

TEST_F(Simulate, NothingIsOverwrittenWithoutForce) {
  ASSERT_EQ(simulate(at("s")).exit_code, 0);
  const Outcome refused = simulate(at("s"), {"--frames", "1", "--seed", "2"});
  expectOneLine(refused, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  ASSERT_EQ(simulate(at("s"), {"--frames", "1", "--force"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(at("s/left/000001.png"))) << "a frame of the earlier simulation stayed";
}

TEST_F(Simulate, AFolderThatCannotBeIsOneLine) {
  write("file", "bytes");
  expectOneLine(simulate(at("file")), 2);
  const Outcome below = simulate(at("file/s"));
  expectOneLine(below, 3);
  EXPECT_THAT(below.err, HasSubstr(at("file/s")));
  EXPECT_THAT(below.err, HasSubstr("Check the path"));
  EXPECT_THAT(below.err, testing::Not(HasSubstr("filesystem")));
}

TEST_F(Simulate, MisspeltKeysGetTheNearestName) {
  const Outcome line = simulate(at("s"), {"--set", "organ.lenght_mm=50"});
  expectOneLine(line, 2);
  EXPECT_THAT(line.err, HasSubstr("organ.length_mm"));
  const Outcome file = simulate(at("s"), {"--scenario", write("s.toml", "[scope]\nbaselin = 4\n")});
  expectOneLine(file, 2);
  EXPECT_THAT(file.err, HasSubstr("baseline_mm"));
  expectOneLine(simulate(at("s"), {"--truth", "msh"}), 2);
  expectOneLine(simulate(at("s"), {"--set", "cut.length_mm=long"}), 2);
  EXPECT_FALSE(fs::exists(at("s")));
}

TEST_F(Simulate, WhatCannotBeSimulatedIsOneLine) {
  const std::vector<std::vector<std::string>> lines{{"--size", "640"},
                                                    {"--size", "9x9"},
                                                    {"--frames", "0"},
                                                    {"--set", "scope.baseline_mm=0"},
                                                    {"--set", "pictures=gif"}};
  for (const auto& line : lines) {
    SCOPED_TRACE(testing::PrintToString(line));
    expectOneLine(simulate(at("s"), line), 2);
    EXPECT_FALSE(fs::exists(at("s")));
  }
  EXPECT_THAT(simulate(at("s"), {"--frames", "0"}).err,
              HasSubstr("--frames: frames is 0, expected"));
  EXPECT_THAT(simulate(at("s"), {"--seed", "-3"}).err, HasSubstr("--seed: seed is -3, expected 0"));
}

}  // namespace
}  // namespace softscope::test
