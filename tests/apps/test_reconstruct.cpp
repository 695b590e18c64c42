// tests/apps/test_reconstruct.cpp: `softscope reconstruct` as a user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "io/images/image_writer.h"
#include "pipeline/backends.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

int linesOf(const fs::path& file) {
  const std::string bytes = textOf(file);
  return static_cast<int>(std::count(bytes.begin(), bytes.end(), '\n'));
}

class Reconstruct : public InFolder {
 protected:
  /// A simulated clip of `frames` frames, 160 x 120.
  std::string makeClip(int frames) const {
    const Outcome made = run({"simulate", "--out", at("clip"), "--frames", std::to_string(frames),
                              "--size", "160x120", "--set", "organ.cells_per_side=30", "--quiet"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return at("clip");
  }
  Outcome reconstruct(std::vector<std::string> more) const {
    std::vector<std::string> all{"reconstruct", at("clip"), "--quiet", "--set",
                                 "stereo.disparity_max_px=63"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(Reconstruct, OptionsReachTheRun) {
  const std::string clip = makeClip(4);
  const Outcome done =
      reconstruct({"--out", at("run"), "--save-every", "2", "--track", clip + "/track_points.csv",
                   "--frames", "0:4", "--hold-out", "3", "--backend", "cpu", "--matcher", "sift",
                   "--scope", "static", "--no-correspondence", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto record = done.json();
  EXPECT_EQ(record, nlohmann::json::parse(textOf(at("run/run.json"))));
  EXPECT_EQ(record["command_line"][0], "reconstruct");
  EXPECT_EQ(record["command_line"][1], "clip") << "no path";
  EXPECT_EQ(record["command_line"][10], "track_points.csv");
  EXPECT_EQ(record["frames"], 3);
  EXPECT_EQ(record["hold_out_every"], 3);
  EXPECT_EQ(record["machine"]["backend"], "cpu");
  EXPECT_EQ(record["configuration"]["matcher.method"], "sift");
  EXPECT_EQ(record["configuration"]["pose.scope"], "static");
  EXPECT_EQ(record["configuration"]["deform.correspondence_weight"], 0);
  EXPECT_TRUE(fs::exists(at("run/tracks.csv")));
  EXPECT_THAT(done.err, HasSubstr("no motion of the scope was detected"));
  const Outcome paper = reconstruct({"--out", at("paper"), "--preset", "paper", "--json"});
  ASSERT_EQ(paper.exit_code, 0) << paper.err;
  EXPECT_EQ(paper.json()["configuration"]["deform.node_model"], "affine");
}

TEST_F(Reconstruct, WarnsOfTrackedPixelsOutsideTheImage) {
  makeClip(2);
  const std::string points =
      write("points.csv", "id,u_px,v_px\n1,80,60\n2,159.6,60\n3,-0.4,119.4\n4,80,-1\n");
  const Outcome done = reconstruct({"--out", at("run"), "--track", points});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("2 of 4 pixels are outside the left image of 160 x 120 px (id 2, "
                                  "4)"));
}

TEST_F(Reconstruct, LimitsSetTheExitCode) {
  makeClip(4);
  const Outcome limited = reconstruct(
      {"--out", at("run"), "--set", "gate.min_confidence=1", "--fail-if", "skipped>10%"});
  EXPECT_EQ(limited.exit_code, 1) << limited.err;
  EXPECT_THAT(limited.err, HasSubstr("outcomes.skipped_share is 0.7500"));
  EXPECT_THAT(limited.err, HasSubstr("frame 1: unconfirmed: "));
  EXPECT_THAT(limited.out, HasSubstr("1 of 4 fused, 3 skipped, 0 lost"));
  EXPECT_TRUE(fs::exists(at("run/run.json"))) << "the run stays";
  EXPECT_EQ(reconstruct({"--out", at("run"), "--force", "--fail-if", "lost>50%"}).exit_code, 0);
  EXPECT_EQ(reconstruct({"--out", at("run"), "--force", "--fail-if", "lsot>10%"}).exit_code, 2);
}

TEST_F(Reconstruct, NeverOverwritesUnasked) {
  makeClip(2);
  write("run/run.json", "{}");
  const Outcome again = reconstruct({"--out", at("run")});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  EXPECT_EQ(reconstruct({"--out", at("run"), "--force", "--frames", "0:1"}).exit_code, 0);
}

TEST_F(Reconstruct, TellsWhatIsWrongWithItsArguments) {
  makeClip(2);
  const auto expect = [&](const std::vector<std::string>& more, int code, const char* text) {
    const Outcome outcome = reconstruct(more);
    EXPECT_EQ(outcome.exit_code, code) << text;
    EXPECT_THAT(outcome.err, HasSubstr(text));
  };
  if (!cudaUnavailableReason().empty())
    expect({"--out", at("r"), "--backend", "cuda"}, 4, "--backend cuda");
  expect({"--out", at("r"), "--backend", "gpu"}, 2, "must be auto, cpu or cuda");
  expect({"--out", at("r"), "--scope", "still"}, 2, "pose.scope");
  expect({"--out", at("r"), "--frames", "1:7:0"}, 2, "--frames");
  expect({"--out", at("r"), "--hold-out", "1"}, 2, "hold");
  expect({"--out", at("r"), "--preset", "papr"}, 2, "must be default or paper");
  expect({"--out", at("r"), "--matcher", "orb"}, 2, "matcher.method is orb");
  expect({"--out", at("r"), "--set", "deform.node_modle=rigid"}, 2, "deform.node_model");
  expect({"--out", at("r"), "--resume"}, 2, "start the run without --resume");
  expect({"--out", write("file", "x")}, 2, "is a file, but must be a folder");
  expect({"--out", at("r"), "--track", write("t.csv", "id,u_px\n")}, 3, "id,u_px,v_px");
  expect({"--out", at("r"), "--track", write("far.csv", "id,u_px,v_px\n1,500,20\n2,3,120\n")}, 3,
         "far.csv: 2 of 2 pixels are outside the left image of 160 x 120 px (id 1, 2)");
  EXPECT_FALSE(fs::exists(at("r"))) << "half-written";
}

#if defined(__has_feature)
#define SOFTSCOPE_SANITIZED __has_feature(address_sanitizer)
#else
#define SOFTSCOPE_SANITIZED 0
#endif
constexpr int kDamages = SOFTSCOPE_SANITIZED ? 25 : 100;  // a round takes six times as long there

// Bytes of pictures, masks, calibration and settings are damaged at random: a clear error or
// skipped frames, never a crash, and what was written is whole.
TEST_F(Reconstruct, SurvivesDamagedInput) {
  const fs::path clip = makeClip(3);
  fs::create_directories(clip / "mask");
  Mask tool(160, 120, 0);  // in a corner
  for (int v = 0; v < 40; ++v) std::fill_n(tool.row(v), 30, std::uint8_t{255});
  for (const char* frame : {"000000", "000001", "000002"})
    writePng(clip / "mask" / (std::string(frame) + ".png"), tool);
  const std::string settings = write("settings.toml", "[stereo]\ndisparity_max_px = 63\n");
  const std::vector<fs::path> victims{clip / "left/000001.png",  clip / "right/000002.png",
                                      clip / "left/000000.png",  clip / "mask/000001.png",
                                      clip / "calibration.yaml", settings};
  std::mt19937 random(4);
  int done = 0;
  for (int round = 0; round < kDamages; ++round) {
    const fs::path victim = victims[static_cast<std::size_t>(round) % victims.size()];
    const std::string good = textOf(victim);
    std::string bad = good;
    for (int k = 0; k < 1 + round % 8; ++k)
      bad[random() % bad.size()] = static_cast<char>(random());
    if (round % 3 == 0) bad.resize(random() % bad.size());
    std::ofstream(victim, std::ios::binary) << bad;
    const Outcome outcome =
        run({"reconstruct", clip, "--quiet", "--out", at("run"), "--force", "--config", settings});
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2 || outcome.exit_code == 3)
        << victim << " ended with " << outcome.exit_code << ": " << outcome.err;
    EXPECT_TRUE(outcome.exit_code == 0 || !outcome.err.empty()) << victim;
    if (outcome.exit_code == 0) {
      ++done;
      EXPECT_EQ(linesOf(at("run/frames.csv")), 1 + 3) << victim;
      EXPECT_EQ(run({"info", at("run/model.ply")}).exit_code, 0) << victim;
    }
    std::ofstream(victim, std::ios::binary) << good;
  }
  EXPECT_GT(done, kDamages / 3);  // a damaged frame doesn't end a run
}

}  // namespace
}  // namespace softscope::test
