// tests/apps/test_reconstruct.cpp: `softscope reconstruct` as a user meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "io/files/file_lock.h"
#include "io/images/image_writer.h"
#include "pipeline/backends.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

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

TEST_F(Reconstruct, WritesTheRunThatOthersRead) {
  const std::string clip = makeClip(5);
  const Outcome done = reconstruct(
      {"--out", at("run"), "--save-every", "2", "--track", clip + "/track_points.csv", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.json()["frames_fused"], 5);
  EXPECT_LT(double(done.json()["mean_backprojection_mm"]), 0.2);
  for (const char* name : {"model.ply", "models/000000.ply", "models/000002.ply",
                           "models/000004.vtp", "models.pvd", "run.json"})
    EXPECT_TRUE(fs::exists(at("run") + "/" + name)) << name;
  EXPECT_FALSE(fs::exists(at("run") + "/checkpoint.bin")) << "nothing is left to resume";
  EXPECT_EQ(linesOf(at("run/frames.csv")), 1 + 5);
  EXPECT_EQ(linesOf(at("run/trajectory.txt")), 1 + 5);
  EXPECT_EQ((linesOf(at("run/tracks.csv")) - 1) % 5, 0);
  EXPECT_THAT(textOf(at("run/model.ply")), HasSubstr("property float weight"));
  const auto record = nlohmann::json::parse(textOf(at("run/run.json")));
  EXPECT_EQ(std::string(record["inputs"]["calibration"]["sha256"]).size(), 64u);
  EXPECT_EQ(record["configuration"]["stereo.disparity_max_px"], 63);
  const auto crate = nlohmann::json::parse(textOf(at("run/ro-crate-metadata.json")));
  EXPECT_EQ(crate["@context"], "https://w3id.org/ro/crate/1.1/context");
  EXPECT_EQ(crate["@graph"][0]["conformsTo"]["@id"], "https://w3id.org/ro/crate/1.1");
  for (const auto& part : crate["@graph"][1]["hasPart"])
    EXPECT_TRUE(fs::exists(at("run/") + std::string(part["@id"]))) << part;
  EXPECT_EQ(crate["@graph"][1]["hasPart"].size(), 10u);
  EXPECT_THAT(crate.dump(), HasSubstr(std::string(record["inputs"]["calibration"]["sha256"])));
  EXPECT_THAT(crate.dump(), Not(HasSubstr(folder.string()))) << "no path of this machine";
}

TEST_F(Reconstruct, SaysWhetherTheScopeMovedAndWhatWasNotFused) {
  makeClip(4);
  const Outcome stated = reconstruct({"--out", at("run"), "--scope", "static", "--json"});
  ASSERT_EQ(stated.exit_code, 0) << stated.err;
  EXPECT_EQ(stated.json()["frames_scope_static"], 3);  // of the three after the first
  EXPECT_THAT(stated.err, HasSubstr("the scope was never seen to move"));
  const Outcome text = reconstruct({"--out", at("run"), "--scope", "moving", "--force"});
  EXPECT_THAT(text.out + text.err, HasSubstr("static in 0 of 3 frames"));
  EXPECT_THAT(text.err, Not(HasSubstr("never seen to move")));
  const Outcome doubted =
      reconstruct({"--out", at("run"), "--set", "gate.min_confidence=1", "--json", "--force"});
  ASSERT_EQ(doubted.exit_code, 0) << doubted.err;
  EXPECT_EQ(doubted.json()["frames_by_status"]["unconfirmed"], 3);
  EXPECT_THAT(std::string(doubted.json()["warnings"].back()),
              HasSubstr("3 of 4 frames were not fused (1 started, 3 unconfirmed)"));
  EXPECT_EQ(doubted.json()["outcomes"]["skipped"], 3);
  EXPECT_THAT(doubted.err, HasSubstr("frame 1: unconfirmed: "));
  EXPECT_THAT(doubted.err, Not(HasSubstr("frame 2: "))) << "one line per kind";
  EXPECT_THAT(doubted.err, HasSubstr("unconfirmed: 2 more frames, 2 to 3; frames.csv"));
  const Outcome limited = reconstruct({"--out", at("run"), "--set", "gate.min_confidence=1",
                                       "--force", "--fail-if", "skipped>10%"});
  EXPECT_EQ(limited.exit_code, 1) << limited.err;
  EXPECT_THAT(limited.err, HasSubstr("outcomes.skipped_share is 0.7500"));
  EXPECT_THAT(limited.out, HasSubstr("1 of 4 fused, 3 skipped, 0 lost"));
  EXPECT_TRUE(fs::exists(at("run/run.json"))) << "the run stays";
  EXPECT_EQ(reconstruct({"--out", at("run"), "--force", "--fail-if", "lsot>10%"}).exit_code, 2);
  EXPECT_EQ(reconstruct({"--out", at("run"), "--scope", "still", "--force"}).exit_code, 2);
}

TEST_F(Reconstruct, EveryStepthFrameKeepsItsNumberAndItsName) {
  const std::string clip = makeClip(7);
  for (const char* side : {"/left", "/right"})
    for (int f = 0; f < 7; ++f)
      fs::rename(clip + side + "/00000" + std::to_string(f) + ".png",
                 clip + side + "/img_00012" + std::to_string(f) + ".png");
  const Outcome done =
      reconstruct({"--out", at("run"), "--frames", "1:7:2", "--save-every", "2", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.json()["frames"], 3);
  EXPECT_EQ(textOf(at("run/images.csv")),
            "frame,number,left,right\n"
            "1,121,\"img_000121.png\",\"img_000121.png\"\n"
            "3,123,\"img_000123.png\",\"img_000123.png\"\n"
            "5,125,\"img_000125.png\",\"img_000125.png\"\n");
  EXPECT_TRUE(fs::exists(at("run/models/000001.ply")));
  EXPECT_FALSE(fs::exists(at("run/models/000003.ply"))) << "every second of those asked for";
  EXPECT_TRUE(fs::exists(at("run/models/000005.ply")));
  EXPECT_THAT(textOf(at("run/trajectory.txt")), HasSubstr("\n0.120000 ")) << "frame 3, not 1";
  EXPECT_EQ(linesOf(at("run/trajectory_kitti.txt")), 3) << "a line per pose, no heading";
  EXPECT_EQ(textOf(at("run/trajectory_kitti.txt")).rfind("1 0 0 0 0 1 0 0 0 0 1 0\n", 0), 0u);
  const Outcome judged = run({"evaluate", at("run"), "--reference", clip, "--json", "--quiet"});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  EXPECT_EQ(judged.json()["outcomes"]["frames"], 3);
  EXPECT_EQ(judged.json()["surface"]["worst_frame"], 5);
  EXPECT_LT(double(judged.json()["surface"]["mean_mm"]), 0.5)
      << "judged by the truth of frame 5: the organ breathes";
  EXPECT_EQ(reconstruct({"--out", at("other"), "--frames", "1:7:0"}).exit_code, 2);
}

TEST_F(Reconstruct, HeldOutFramesAreNotSeenAndAreComparedWithTheModelBeforeThem) {
  makeClip(10);
  const std::vector<std::string> words{"--hold-out", "4", "--save-every", "0"};
  auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return reconstruct(all);
  };
  const Outcome done = with({"--out", at("run"), "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.json()["frames"], 7);
  EXPECT_EQ(done.json()["hold_out_every"], 4);
  const std::string frames = textOf(at("run/frames.csv"));
  for (const char* number : {"\n0,", "\n4,", "\n6,", "\n8,"})
    EXPECT_THAT(frames, HasSubstr(number));
  for (const char* number : {"\n1,", "\n5,", "\n9,"}) EXPECT_THAT(frames, Not(HasSubstr(number)));
  for (const char* model :
       {"run/models/000000.ply", "run/models/000004.ply", "run/models/000008.ply"})
    EXPECT_TRUE(fs::exists(at(model))) << model;

  // The same with truth and without.
  const Outcome judged = run({"evaluate", at("run"), "--reference", at("clip"), "--json"});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  const auto held_out = judged.json()["held_out"];
  EXPECT_EQ(held_out["every"], 4);
  ASSERT_EQ(held_out["views"], 3);
  EXPECT_EQ(held_out["frames"][1]["frame"], 5);
  EXPECT_EQ(held_out["frames"][2]["frame"], 9) << "the last of the clip";
  EXPECT_GT(held_out["psnr_db"], 25);
  EXPECT_GT(held_out["psnr_over_all_pixels_db"], held_out["psnr_db"]);
  EXPECT_TRUE(held_out["control"]["psnr_db"].is_number());
  EXPECT_EQ(held_out["control"]["judged_share"], held_out["judged_share"]) << "the same pixels";
  EXPECT_THAT(std::string(held_out["pixels"]), HasSubstr("masks"));
  fs::remove_all(at("clip/groundtruth"));
  const Outcome truthless = run({"evaluate", at("run"), "--reference", at("clip"), "--json",
                                 "--fail-if", "held_out.psnr_db<5", "--out", at("error")});
  ASSERT_EQ(truthless.exit_code, 0) << truthless.err;
  EXPECT_EQ(truthless.json()["held_out"]["frames"], held_out["frames"]);
  ASSERT_EQ(run({"report", at("error"), "--out", at("page.html")}).exit_code, 0);
  EXPECT_THAT(textOf(at("page.html")), HasSubstr("that the run did not see, over 3 frames"));

  // A range may begin at such a frame, and a run that was stopped goes on with the same split.
  const Outcome later = with({"--out", at("later"), "--frames", "5:9", "--json"});
  ASSERT_EQ(later.exit_code, 0) << later.err;
  EXPECT_EQ(later.json()["frames"], 3);
  EXPECT_EQ(with({"--out", at("no"), "--frames", "::2"}).exit_code, 2);
  EXPECT_EQ(with({"--out", at("no"), "--frames", "5:6"}).exit_code, 2) << "nothing is left";
  EXPECT_EQ(reconstruct({"--out", at("no"), "--hold-out", "1"}).exit_code, 2);
}

TEST_F(Reconstruct, AnUnreadableFrameKeepsItsTime) {
  const std::string clip = makeClip(4);
  fs::resize_file(clip + "/left/000002.png", 200);
  ASSERT_EQ(reconstruct({"--out", at("run")}).exit_code, 0);
  EXPECT_THAT(textOf(at("run/trajectory.txt")), HasSubstr("\n0.080000 ")) << "not 2 seconds";
  const Outcome judged = run({"evaluate", at("run"), "--reference", clip, "--json", "--quiet"});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  EXPECT_EQ(judged.json()["outcomes"]["skipped"], 1);
}

TEST_F(Reconstruct, ResumesToTheSameBytes) {
  makeClip(8);
  ASSERT_EQ(reconstruct({"--out", at("whole")}).exit_code, 0);
  const std::string out = at("stopped");
  const pid_t child = fork();
  if (child == 0) {
    execl(executable().c_str(), "softscope", "reconstruct", at("clip").c_str(), "--out",
          out.c_str(), "--quiet", "--set", "stereo.disparity_max_px=63", "--checkpoint-every", "1",
          nullptr);
    _exit(127);
  }
  for (int i = 0; i < 3000 && !fs::exists(out + "/checkpoint.bin"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 0) GTEST_SKIP() << "the run was over before the signal came";
  ASSERT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(nlohmann::json::parse(textOf(out + "/run.json"))["interrupted"]);
  ASSERT_EQ(reconstruct({"--out", out, "--set", "graph.node_spacing_mm=5", "--resume"}).exit_code,
            2)
      << "other settings can't be gone on with";
  const Outcome resumed = reconstruct({"--out", out, "--checkpoint-every", "1", "--resume"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  for (const char* name : {"model.ply", "trajectory.txt", "models/000000.ply", "models.pvd"})
    EXPECT_TRUE(textOf(out + "/" + name) == textOf(at("whole") + "/" + name)) << name;
  EXPECT_EQ(linesOf(out + "/frames.csv"), 1 + 8);
}

// A clip whose right video was cut a picture later: moment f is right picture f - 1.
TEST_F(Reconstruct, PairsTheViewsOfOneMoment) {
  makeClip(9);
  fs::remove(at("clip/timestamps.txt"));
  for (int f = 0; f < 9; ++f) {
    const std::string name = "/00000" + std::to_string(f) + ".png";
    if (f > 0)
      fs::rename(at("clip") + "/right" + name,
                 at("clip") + "/right/00000" + std::to_string(f - 1) + ".png");
    if (f == 8) fs::remove(at("clip") + "/left" + name);
  }
  const Outcome done = reconstruct({"--out", at("run"), "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("right image f -1 belongs to left image f"));
  EXPECT_EQ(done.json()["configuration"]["sequence.right_offset"], "-1");
  EXPECT_EQ(done.json()["frames_fused"], 7);
  EXPECT_EQ(done.json()["frames_by_status"]["unpaired"], 1) << "nothing is wrong with its files";
  EXPECT_LT(double(done.json()["mean_backprojection_mm"]), 0.2);
  const auto told = run({"info", at("clip"), "--json"}).json();
  EXPECT_EQ(told["right_offset"], -1) << "the same for every command";
  EXPECT_THAT(told["warnings"].dump(), HasSubstr("belongs to left image f"));
  const Outcome depth = run({"depth", at("clip"), "--out", at("depth"), "--json", "--frames", "0:2",
                             "--set", "stereo.disparity_max_px=63"});
  EXPECT_EQ(depth.json()["options"]["sequence.right_offset"], "-1");
  EXPECT_EQ(depth.json()["frames_done"], 1) << "frame 0 has no partner";
  const Outcome as_is =
      reconstruct({"--out", at("as_is"), "--json", "--set", "sequence.right_offset=0"});
  // Fusion follows wrong depth too; the model that was warped only knows better.
  EXPECT_GT(double(as_is.json()["mean_prediction_mm"]),
            1.2 * double(done.json()["mean_prediction_mm"]));
}

// Depth and colour of one camera, then depth alone: no word of stereo, and the model is as good.
TEST_F(Reconstruct, TakesDepthWithColourAndDepthAlone) {
  const Outcome made =
      run({"simulate", "--out", at("clip"), "--frames", "6", "--size", "160x120", "--set",
           "organ.cells_per_side=30", "--set", "input_depth=true", "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto rig = run({"info", at("clip"), "--json"}).json()["calibration"]["left"];
  fs::remove_all(at("clip/right"));
  write("clip/calibration.yaml", "fx: " + rig["fx_px"].dump() + "\ncx: " + rig["cx_px"].dump() +
                                     "\ncy: " + rig["cy_px"].dump() + "\ndepth_unit_mm: 0.01\n");
  for (const bool colour : {true, false}) {
    if (!colour) fs::remove_all(at("clip/left"));
    const Outcome described = run({"info", at("clip")});
    EXPECT_EQ(described.exit_code, 0) << described.out << described.err;
    EXPECT_THAT(described.out, Not(HasSubstr("baseline")));
    const std::string out = at(colour ? "colour" : "depth");
    const Outcome done = reconstruct({"--out", out, "--json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.json()["frames_fused"], 6) << done.err;
    EXPECT_TRUE(done.json()["rectified_rig"]["baseline_mm"].is_null());
    const Outcome judged = run({"evaluate", out, "--reference", at("clip"), "--json", "--quiet"});
    ASSERT_EQ(judged.exit_code, 0) << judged.err;
    EXPECT_LT(double(judged.json()["surface"]["mean_mm"]), 0.2) << "0.01 mm is a step of the files";
    const Outcome depth = run({"depth", at("clip"), "--out", out + "_maps", "--write", "depth"});
    EXPECT_EQ(depth.exit_code, 0) << depth.err;
    EXPECT_THAT(depth.out, HasSubstr("depth of 6 frames from depth files"));
    EXPECT_THAT(depth.out, Not(HasSubstr("pair")));
  }
}

TEST_F(Reconstruct, NeverOverwritesUnasked) {
  makeClip(2);
  ASSERT_EQ(reconstruct({"--out", at("run")}).exit_code, 0);
  const std::string before = textOf(at("run/model.ply"));
  const Outcome again = reconstruct({"--out", at("run")});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  EXPECT_EQ(textOf(at("run/model.ply")), before);
  EXPECT_EQ(reconstruct({"--out", at("run"), "--force", "--frames", "0:1"}).exit_code, 0);
  EXPECT_EQ(linesOf(at("run/frames.csv")), 2);
  EXPECT_FALSE(fs::exists(at("run/writing.lock"))) << "the run has ended";
  const FileLock other(at("run/writing.lock"));
  ASSERT_TRUE(other.tryToHold());
  const Outcome both = reconstruct({"--out", at("run"), "--force"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("another softscope reconstruct is writing to it"));
  EXPECT_EQ(linesOf(at("run/frames.csv")), 2) << "nothing was touched";
}

TEST_F(Reconstruct, TellsBackEndAndTimeOfAFrame) {
  makeClip(2);
  const Outcome done = reconstruct({"--out", at("run"), "--backend", "cpu", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto json = nlohmann::json::parse(done.out);
  EXPECT_EQ(json["machine"]["backend"], "cpu");
  const auto& ms = json["frame_ms"];
  EXPECT_GT(ms["p50"].get<double>(), 0);
  EXPECT_LE(ms["p50"].get<double>(), ms["p95"].get<double>());
  EXPECT_LE(ms["p99"].get<double>(), ms["slowest"].get<double>());
  const Outcome slow =
      reconstruct({"--out", at("run"), "--force", "--fail-if", "frame_ms.p95>1000000"});
  EXPECT_EQ(slow.exit_code, 0) << slow.err;
}

TEST_F(Reconstruct, TellsWhatIsWrongWithItsArguments) {
  makeClip(2);
  const auto expect = [&](const std::vector<std::string>& more, int code, const char* text) {
    const Outcome outcome = reconstruct(more);
    EXPECT_EQ(outcome.exit_code, code) << text;
    EXPECT_THAT(outcome.err, HasSubstr(text));
  };
  if (!whyNoCuda().empty()) expect({"--out", at("r"), "--backend", "cuda"}, 4, "--backend cuda");
  expect({"--out", at("r"), "--backend", "gpu"}, 2, "must be auto, cpu or cuda");
  expect({"--out", at("r"), "--preset", "papr"}, 2, "must be default or paper");
  expect({"--out", at("r"), "--matcher", "orb"}, 2, "matcher.method is orb");
  expect({"--out", at("r"), "--set", "deform.node_modle=rigid"}, 2, "deform.node_model");
  expect({"--out", at("r"), "--resume"}, 2, "start the run without --resume");
  expect({"--out", write("file", "x")}, 2, "is a file, but must be a folder");
  expect({"--out", at("r"), "--track", write("t.csv", "id,u_px\n")}, 3, "id,u_px,v_px");
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
