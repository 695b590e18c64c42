// tests/apps/test_view.cpp: `softscope view` as a user meets it, with a screen and without one.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "io/files/file_lock.h"
#include "io/images/image_reader.h"
#include "io/images/image_writer.h"
#include "io/sequences/picture_source.h"
#include "support/x_server.h"
#include "tests/apps/evaluate_fixture.h"
#include "vtk_views/scenes/render_check.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

int countNear(const ColourImage& picture, Rgb8 colour, int by) {
  return static_cast<int>(
      std::count_if(picture.values.begin(), picture.values.end(), [&](const Rgb8& c) {
        return std::abs(c.red - colour.red) <= by && std::abs(c.green - colour.green) <= by &&
               std::abs(c.blue - colour.blue) <= by;
      }));
}

constexpr Rgb8 kWall{200, 100, 90};  // what made_run.cpp paints it

/// A moving wall of 80 x 80 mm: six models and their truth.
class View : public Evaluate {
 protected:
  Outcome view(std::vector<std::string> more) const {
    std::vector<std::string> line{"view", at("run")};
    line.insert(line.end(), more.begin(), more.end());
    return run(line);
  }
  Outcome screenshot(std::vector<std::string> more) const {
    more.insert(more.end(), {"--screenshot", at("view.png"), "--size", "480x360", "--force"});
    return view(more);
  }
  ColourImage picture(const std::vector<std::string>& more = {}) const {
    const Outcome outcome = screenshot(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return readColourImage(at("view.png"));
  }
  void SetUp() override {
    Evaluate::SetUp();
    static const bool renders = checkRendering().works;
    if (!renders) GTEST_SKIP() << "nothing renders on this machine";
  }
};

TEST_F(View, ACleanPictureIsTheViewAlone) {
  const ColourImage clean = picture({"--clean", "--look", "scope"});
  ASSERT_EQ(clean.height_px, 360);
  EXPECT_EQ(countNear(clean, {0, 110, 170}, 8), 0) << "the slider's blue";
  EXPECT_GT(countNear(picture({"--look", "scope"}), {0, 110, 170}, 8), 20);
  int wall = 0;  // where the foot would be
  for (int v = 272; v < 360; ++v)
    for (int u = 0; u < 480; ++u) wall += std::abs(clean.at(u, v).green - kWall.green) < 40;
  EXPECT_GT(wall, 480 * 88 / 10) << "the wall's dots, with gaps between them: 14 % of the pixels";
  EXPECT_EQ(view({"--clean"}).exit_code, 2) << "a window keeps its slider";
}

TEST_F(View, LettersKeepTheirShareOfALargePicture) {
  const auto blueRows = [&](const char* size) {  // of the slider, left of its knob
    EXPECT_EQ(view({"--screenshot", at("large.png"), "--size", size, "--force"}).exit_code, 0);
    const ColourImage shown = readColourImage(at("large.png"));
    int rows = 0;
    for (int v = shown.height_px - shown.height_px / 6; v < shown.height_px; ++v) {
      const Rgb8 c = shown.at(shown.width_px / 2, v);
      rows += c.red < 60 && std::abs(c.blue - 170) < 60;
    }
    return rows;
  };
  const int usual = blueRows("960x720");
  EXPECT_GE(usual, 2);
  EXPECT_GT(blueRows("1920x1440"), usual + 1) << "a line of 3 px becomes one of 6";
}

TEST_F(View, AScreenshotShowsTheTissueWithoutADisplay) {
  const ColourImage shown = picture();
  EXPECT_EQ(shown.width_px, 480);
  EXPECT_EQ(shown.height_px, 360);
  EXPECT_GT(countNear(shown, kWall, 3), 10000);
  EXPECT_GT(countNear(shown, {255, 255, 255}, 0), 10000) << "figures are on white";
  EXPECT_EQ(screenshot({"--json", "--frame", "3"}).json()["screenshot"]["frame"], 3);
  EXPECT_EQ(view({"--screenshot", at("view.png")}).exit_code, 2) << "it is there already";
}

TEST_F(View, ErrorsComeFromTheTruthOrFromAnEvaluation) {
  const ColourImage measured = picture({"--reference", at("truth"), "--colour", "errors"});
  EXPECT_EQ(countNear(measured, kWall, 3), 0);
  ASSERT_EQ(evaluate({"--out", at("evaluation")}).exit_code, 0);
  const ColourImage read = picture({"--evaluation", at("evaluation"), "--colour", "errors",
                                    "--reference", at("truth"), "--range-mm", "0.5"});
  const ColourImage again =
      picture({"--reference", at("truth"), "--colour", "errors", "--range-mm", "0.5"});
  // The wall has 6561 points, fewer than a map keeps: both show the same errors, to rounding.
  int different = 0;
  for (std::size_t i = 0; i < read.size(); ++i)
    different += std::abs(read.values[i].green - again.values[i].green) > 3;
  EXPECT_LT(different, 200);
}

TEST_F(View, AnEvaluationOfAnotherRunIsRefused) {
  ASSERT_EQ(evaluate({"--out", at("evaluation")}).exit_code, 0);
  fs::copy_file(at("run/models/000001.ply"), at("run/models/000005.ply"),
                fs::copy_options::overwrite_existing);
  expectRefused({"000005.vtp", "evaluate the run again"},
                screenshot({"--evaluation", at("evaluation"), "--colour", "errors"}));
  expectRefused({"errors/NNNNNN.vtp"}, screenshot({"--evaluation", at("truth")}));
}

TEST_F(View, AMovieHasItsFramesSizeAndMotion) {
  const Outcome outcome = view({"--movie", at("view.mp4"), "--size", "400x300", "--fps", "10",
                                "--seconds", "1.2", "--turn", "60", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["movie"]["frames"], 12);
  EXPECT_THAT(outcome.err, HasSubstr("movie 12/12"));
  const auto movie = openPictures(at("view.mp4"));
  ASSERT_EQ(movie->count(), 12);
  const ColourImage first = movie->read(0), last = movie->read(11);
  EXPECT_EQ(first.width_px, 400);
  EXPECT_EQ(first.height_px, 300);
  EXPECT_GT(countNear(first, kWall, 25), 5000);  // what a codec leaves of it
  int different = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    different += std::abs(first.values[i].green - last.values[i].green) > 40;
  EXPECT_GT(different, 2000);
}

TEST_F(View, AMovieOfTheClipLastsAsLongAsTheClip) {
  // Six frames of 0.04 s each, half as fast.
  const Outcome outcome = view({"--movie", at("view.mp4"), "--size", "320x240", "--speed", "0.5",
                                "--fps", "25", "--json", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["movie"]["frames"], 12);
}

TEST_F(View, ARunWhoseWriterIsGoneIsCalledStopped) {
  {
    const FileLock writer(at("run/writing.lock"));
    ASSERT_TRUE(writer.tryToHold());
    EXPECT_THAT(screenshot({}).err, testing::Not(HasSubstr("stopped")));
  }
  EXPECT_THAT(screenshot({}).err, HasSubstr("stopped before its end"));
  write("run/run.json", "{}");
  EXPECT_THAT(screenshot({}).err, testing::Not(HasSubstr("stopped")));
}

TEST_F(View, TheLastModelAloneCanBeSeen) {
  fs::remove_all(at("run/models"));
  EXPECT_GT(countNear(picture(), kWall, 3), 10000);
}

TEST_F(View, BadRunsAreRefused) {
  const auto refused = [&](const std::string& name, const std::vector<std::string>& parts) {
    expectRefused(parts, run({"view", at(name), "--screenshot", at("x.png")}));
  };
  refused("nowhere", {"nowhere"});
  fs::create_directories(at("empty"));
  refused("empty", {"empty", "holds no model", "--wait"});
  const std::string whole = textOf(at("run/models/000005.ply"));
  fs::remove(at("run/models/000005.ply"));
  write("run/models/000005.ply", whole.substr(0, whole.size() / 2));
  refused("run", {"000005.ply"});
}

TEST_F(View, WrongOptionsAreNamed) {
  const auto wrong = [&](const std::vector<std::string>& options, const std::string& part) {
    const Outcome outcome = screenshot(options);
    EXPECT_EQ(outcome.exit_code, 2) << part << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  };
  wrong({"--colour", "errors"}, "--reference or --evaluation");
  wrong({"--colour", "blue"}, "texture, errors, weights");
  wrong({"--look", "sideways"}, "free, scope, front");
  wrong({"--frame", "99"}, "frames 0 to 5");
  wrong({"--turn", "1e9"}, "--turn");
  EXPECT_EQ(view({"--movie", at("a.mp4"), "--size", "401x300"}).exit_code, 2);
  EXPECT_EQ(view({"--screenshot", at("a.png"), "--size", "10x10"}).exit_code, 2);
}

TEST_F(View, AMotionIntoTheCtMustBeRigid) {
  expectRefused({"m.txt", "rigid motion"},
                screenshot({"--reference", at("truth/groundtruth/mesh/000000.ply"), "--ct-from-run",
                            write("m.txt", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")}));
}

TEST_F(View, WithoutADisplayTheWindowSaysWhatWorksInstead) {
  const Outcome outcome = view({});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("--screenshot"));
  EXPECT_THAT(outcome.err, HasSubstr("--movie"));
}

TEST_F(View, TheWindowOpensPlaysAndClosesOnRequest) {
  const XServer server;
  if (!server.problem().empty()) GTEST_SKIP() << server.problem();
  const std::string line = "DISPLAY=" + server.display() + " exec '" + executable() + "' view '" +
                           at("run") + "' --play --verbose 2>'" + at("log") + "'";
  const pid_t shell = fork();
  if (shell == 0) {
    execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  const auto moment = std::chrono::milliseconds(20);
  for (int i = 0; i < 1000 && textOf(at("log")).find("window is open") == std::string::npos; ++i)
    std::this_thread::sleep_for(moment);
  std::this_thread::sleep_for(10 * moment);  // plays
  kill(shell, SIGTERM);
  int status = -1;
  waitpid(shell, &status, 0);
  EXPECT_EQ(status, 0) << textOf(at("log"));
  EXPECT_THAT(textOf(at("log")), HasSubstr("images, "));
}

class SavedRun : public InFolder {};

TEST_F(SavedRun, AModelOfARunTellsItsMomentAndItsNodes) {
  ASSERT_EQ(run({"simulate", "--out", at("clip"), "--frames", "3", "--size", "160x120", "--set",
                 "organ.cells_per_side=30", "--quiet"})
                .exit_code,
            0);
  ASSERT_EQ(run({"reconstruct", at("clip"), "--out", at("run"), "--save-every", "1", "--quiet",
                 "--set", "stereo.disparity_max_px=63"})
                .exit_code,
            0);
  const std::string head = textOf(at("run/models/000002.ply")).substr(0, 600);
  EXPECT_THAT(head, HasSubstr("comment world_from_left "));
  EXPECT_THAT(head, HasSubstr("comment left_camera 160 120 "));
  EXPECT_THAT(textOf(at("run/nodes/000002.csv")), HasSubstr("node,x_mm,y_mm,z_mm\n0,"));
  fs::remove(at("run/run.json"));  // as while it goes on: then no table is needed either
  fs::remove(at("run/trajectory.txt"));
  fs::remove(at("run/frames.csv"));
  const Outcome seen = run({"view", at("run"), "--nodes", "--arrows", "--look", "scope",
                            "--screenshot", at("view.png")});
  EXPECT_TRUE(seen.exit_code == 0 || seen.exit_code == 4) << seen.err;
  EXPECT_THAT(seen.err, testing::Not(HasSubstr("warning"))) << "nodes and camera are known";
}

}  // namespace
}  // namespace softscope::test
