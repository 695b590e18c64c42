// tests/apps/test_maps.cpp: places that the first model lacks, in the files of a run.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "io/files/folder.h"
#include "io/images/image_writer.h"
#include "support/run_results.h"
#include "tests/apps/run_softscope.h"
#include "tests/io/temporary_folder.h"
#include "toolkit/run/models_on_disk.h"
#include "toolkit/run/run_reader.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kWidth = 160, kHeight = 120;
constexpr int kLeftFrames = 6, kRightFrames = 18, kWholeFrames = 6;

class Maps : public InFolder {
 protected:
  /// Six frames, simulated once for all tests.
  static const TemporaryFolder& sixFrames() {
    static const TemporaryFolder folder;
    static const Outcome made =
        softscope::test::run({"simulate", "--out", folder / "clip", "--frames", "6", "--size",
                              "160x120", "--set", "organ.cells_per_side=40", "--quiet"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder;
  }
  /// The left half of the images, then the right one for long, then both: there and back in time.
  void makeClip() const {
    const fs::path from = sixFrames() / "clip", clip = at("clip");
    for (const char* folder : {"left", "right", "mask"}) fs::create_directories(clip / folder);
    fs::copy_file(from / "calibration.yaml", clip / "calibration.yaml");
    for (int i = 0; i < kLeftFrames + kRightFrames + kWholeFrames; ++i) {
      const int moment = i % 10 < 6 ? i % 10 : 10 - i % 10;
      for (const char* view : {"left", "right"})
        fs::copy_file(from / view / numberedName(moment, ".png"),
                      clip / view / numberedName(i, ".png"));
      const bool is_left = i < kLeftFrames, is_right = !is_left && i < kLeftFrames + kRightFrames;
      GrayImage mask(kWidth, kHeight, 0);
      for (int v = 0; v < kHeight; ++v)
        for (int u = 0; u < kWidth; ++u)
          if ((is_left && u >= 86) || (is_right && u < 100)) mask.at(u, v) = 255;
      writePng(clip / "mask" / numberedName(i, ".png"), mask);
    }
  }
  std::vector<std::string> command(const std::string& out) const {
    return {"reconstruct",
            at("clip"),
            "--out",
            at(out),
            "--quiet",
            "--checkpoint-every",
            "8",
            "--set",
            "stereo.disparity_max_px=63",
            "--save-every",
            "1"};
  }
  Outcome reconstruct(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = command(out);
    all.insert(all.end(), more.begin(), more.end());
    return softscope::test::run(all);
  }
  /// Kills a run once the model of frame `last` is there.
  void killedRun(const std::string& out, int last) const {
    const pid_t child = fork();
    if (child == 0) {
      std::vector<std::string> words = command(out);
      words.insert(words.begin(), "softscope");
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(executable().c_str(), arguments.data());
      _exit(127);
    }
    const fs::path model = fs::path(at(out)) / "models" / numberedName(last, ".ply");
    for (int i = 0; i < 12000 && !fs::exists(model); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
  }
};

TEST_F(Maps, OfAnotherPlaceIsSaidToBeOne) {
  makeClip();
  const Outcome done = reconstruct("run", {"--frames", "0:24"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("models of other places"));
  const auto record = nlohmann::json::parse(textOf(at("run/run.json")));
  EXPECT_EQ(record["maps"], 2);
  const JudgedRun run = openJudgedRun(at("run"));
  EXPECT_TRUE(run.isPlaced(kLeftFrames - 1));
  EXPECT_TRUE(run.counts(23));
  EXPECT_FALSE(run.isPlaced(23));
  EXPECT_EQ(record["frames_in_other_maps"],
            std::count_if(run.frames.begin(), run.frames.end(),
                          [&](int f) { return run.counts(f) && !run.isPlaced(f); }));
  EXPECT_TRUE(fs::exists(at("run/model_map0.ply")));
}

TEST_F(Maps, ThatOverlapAreOneInAllFiles) {
  makeClip();
  const Outcome done = reconstruct("whole");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(nlohmann::json::parse(textOf(at("whole/run.json")))["maps"], 1);
  EXPECT_FALSE(fs::exists(at("whole/model_map0.ply")));
  const JudgedRun run = openJudgedRun(at("whole"));
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    EXPECT_EQ(run.maps.at(run.frames[k]), 0);
    const ModelOnDisk model = readModelHead(run.frames[k], run.models.at(run.frames[k]));
    ASSERT_TRUE(model.world_from_left);
    EXPECT_TRUE(model.world_from_left->isApprox(run.trajectory[k].world_from_left, 1e-6))
        << "frame " << run.frames[k];
  }
  killedRun("run", 27);  // the join is done on disk, but not in the tables
  const Outcome resumed = reconstruct("run", {"--resume"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const auto whole = resultsIn(at("whole"));
  const auto found = resultsIn(at("run"));
  EXPECT_EQ(found.size(), whole.size());
  for (const auto& [name, bytes] : whole)
    EXPECT_TRUE(found.count(name) == 1 && found.at(name) == bytes) << name;
}

}  // namespace
}  // namespace softscope::test
