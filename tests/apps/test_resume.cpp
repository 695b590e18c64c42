// tests/apps/test_resume.cpp: a run that was stopped anywhere can be finished, and nothing stays
// behind.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "io/files/folder.h"
#include "support/run_results.h"
#include "tests/apps/run_softscope.h"
#include "tests/io/temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

int framesIn(const fs::path& run_folder) {
  const std::string csv = textOf(run_folder / "frames.csv");
  return static_cast<int>(std::count(csv.begin(), csv.end(), '\n')) - 1;
}

class Resume : public InFolder {
 protected:
  /// Four frames, simulated once for all tests.
  static const TemporaryFolder& fourFrames() {
    static const TemporaryFolder folder;
    static const Outcome made =
        softscope::test::run({"simulate", "--out", folder / "clip", "--frames", "4", "--size",
                              "160x120", "--set", "organ.cells_per_side=30", "--quiet"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder;
  }
  /// 60 frames of four moments, there and back: a motion as smooth as that of 60 simulated ones.
  void makeLongClip() const {
    const fs::path four = fourFrames() / "clip", clip = at("clip");
    for (const char* view : {"left", "right"}) {
      fs::create_directories(clip / view);
      for (int i = 0; i < 60; ++i)
        fs::copy_file(four / view / numberedName(i % 6 < 4 ? i % 6 : 6 - i % 6, ".png"),
                      clip / view / numberedName(i, ".png"));
    }
    fs::copy_file(four / "calibration.yaml", clip / "calibration.yaml");
  }

  /// Ends a run over a long clip by `signal_number`, or by what `act` does, once the model of frame
  /// `last` is there; the frames that were done.
  int interruptedRun(int signal_number, const std::function<void()>& act = {}, int last = 2,
                     const std::string& checkpoint_every = "100") const {
    makeLongClip();
    const std::string clip = at("clip"), out = at("run");
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGHUP, SIG_DFL);  // which `nohup ./test.sh` has ignored, and the program leaves it so
      execl(executable().c_str(), "softscope", "reconstruct", clip.c_str(), "--out", out.c_str(),
            "--quiet", "--save-every", "1", "--set", "stereo.disparity_max_px=63",
            "--checkpoint-every", checkpoint_every.c_str(), nullptr);
      _exit(127);
    }
    const std::string model = out + "/models/00000" + std::to_string(last) + ".ply";
    for (int i = 0; i < 6000 && !fs::exists(model); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (act) act();
    kill(child, signal_number);  // 0: none
    int status = 0;
    waitpid(child, &status, 0);
    const int expected = signal_number == SIGKILL ? 128 + SIGKILL : act ? 3 : 130;
    EXPECT_EQ(WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), expected);
    return framesIn(out);
  }
  Outcome resume(const std::vector<std::string>& more) const {
    std::vector<std::string> all{
        "reconstruct", at("clip"), "--out",   at("run"), "--save-every",
        "1",           "--resume", "--quiet", "--set",   "stereo.disparity_max_px=63"};
    all.insert(all.end(), more.begin(), more.end());
    return softscope::test::run(all);
  }
};

TEST_F(Resume, ARunStoppedAfterItsLastFrameIsFinished) {
  const int done = interruptedRun(SIGINT);
  ASSERT_GE(done, 3);
  const std::string model = textOf(at("run/model.ply"));
  std::ofstream(at("run/.model.ply.123-4.part")) << "half";
  std::ofstream(at("run/models/.000001.ply.123-77.part")) << "half";
  std::ofstream(at("run/.mine.part")) << "another program's";
  const Outcome resumed = resume({"--frames", "0:" + std::to_string(done)});  // none is left
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(textOf(at("run/model.ply")), model);
  const auto record = nlohmann::json::parse(textOf(at("run/run.json")));
  EXPECT_EQ(record["frames"], done) << "those before the stop count";
  EXPECT_EQ(record["interrupted"], false);
  EXPECT_EQ(framesIn(at("run")), done);
  EXPECT_FALSE(fs::exists(at("run/checkpoint.bin")));
  EXPECT_FALSE(fs::exists(at("run/.model.ply.123-4.part")));
  EXPECT_FALSE(fs::exists(at("run/models/.000001.ply.123-77.part")));
  EXPECT_TRUE(fs::exists(at("run/.mine.part"))) << "only what AtomicFile leaves is removed";
  const std::string list = textOf(at("run/models.pvd"));
  EXPECT_EQ(list.find("000002.vtp"), list.rfind("000002.vtp")) << "each model once";
}

TEST_F(Resume, AnotherPictureIsAnotherRun) {
  const int done = interruptedRun(SIGINT);
  const std::string left = at("clip/left/000000.png"), other = at("clip/left/000001.png");
  fs::remove(left);
  fs::copy_file(other, left);
  const Outcome resumed = resume({"--frames", "0:" + std::to_string(done + 1)});
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_THAT(resumed.err, HasSubstr("other settings, images"));
}

TEST_F(Resume, PicturesThatVanishEndTheRunAndCanBePutBack) {
  const auto without_pictures = [this] { fs::rename(at("clip/left"), at("clip/gone")); };
  const int done = interruptedRun(0, without_pictures);
  ASSERT_GE(done, 3);
  ASSERT_LT(done, 60);
  fs::rename(at("clip/gone"), at("clip/left"));
  const Outcome resumed = resume({"--frames", "0:" + std::to_string(done + 1)});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(nlohmann::json::parse(textOf(at("run/run.json")))["frames"], done + 1);
}

TEST_F(Resume, ARunKilledBeforeItsFirstCheckpointStartsAnew) {
  const int none = interruptedRun(SIGKILL);
  EXPECT_EQ(none, -1) << "no table yet";
  const Outcome resumed = resume({"--frames", "0:3"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("starts from the first frame"));
  EXPECT_EQ(nlohmann::json::parse(textOf(at("run/run.json")))["frames"], 3);
  EXPECT_EQ(countFiles(at("run/models")), 6)
      << "nothing of the killed run, a PLY and VTP per frame";
  EXPECT_EQ(resume({}).exit_code, 2) << "a complete run is none to resume";
}

TEST_F(Resume, AKilledRunGoesBackToItsCheckpointAndForgetsWhatCameAfterIt) {
  const int done = interruptedRun(SIGKILL, {}, 6, "4");
  ASSERT_EQ(done % 4, 0) << "tables are those of a checkpoint";
  ASSERT_GE(done, 4);
  ASSERT_LT(done, 60);
  const std::string frames = "0:" + std::to_string(done + 4);
  const Outcome resumed = resume({"--checkpoint-every", "4", "--frames", frames});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const auto record = nlohmann::json::parse(textOf(at("run/run.json")));
  EXPECT_EQ(record["resumed_at_frame"].get<int>() % 4, 0);
  EXPECT_EQ(framesIn(at("run")), done + 4) << "each frame once";
  const Outcome whole = softscope::test::run(
      {"reconstruct", at("clip"), "--out", at("whole"), "--save-every", "1", "--quiet", "--set",
       "stereo.disparity_max_px=63", "--checkpoint-every", "4", "--frames", frames});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(resultsIn(at("run")), resultsIn(at("whole")));
}

TEST_F(Resume, AClosedTerminalLosesNothing) {
  const int done = interruptedRun(SIGHUP);
  ASSERT_GE(done, 3);
  const Outcome resumed = resume({"--frames", "0:" + std::to_string(done + 1)});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const auto record = nlohmann::json::parse(textOf(at("run/run.json")));
  EXPECT_EQ(record["frames"], done + 1);
  EXPECT_EQ(record["resumed_at_frame"], done);
}

}  // namespace
}  // namespace softscope::test
