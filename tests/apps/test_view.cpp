// tests/apps/test_view.cpp: `softscope view`: options, lines, and the window, with a screen and
// without one.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "io/images/image_reader.h"
#include "support/x_server.h"
#include "tests/apps/evaluate_fixture.h"
#include "vtk_views/scenes/render_check.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A moving wall of 80 x 80 mm: six models and their truth.
class View : public Evaluate {
 protected:
  Outcome view(std::vector<std::string> more) const {
    more.insert(more.begin(), {"view", at("run")});
    return run(more);
  }
  Outcome screenshot(std::vector<std::string> more) const {
    more.insert(more.end(), {"--screenshot", at("view.png"), "--size", "480x360"});
    return view(more);
  }
  void SetUp() override {
    Evaluate::SetUp();
    static const bool renders = checkRendering().works;
    if (!renders) GTEST_SKIP() << "nothing renders on this machine";
  }
};

TEST_F(View, OptionsReachTheScreenshot) {
  const Outcome shown = screenshot({"--reference", at("truth"), "--colour", "errors", "--errors",
                                    "signed", "--range-mm", "0.5", "--look", "scope", "--nodes",
                                    "--arrows", "--no-scope", "--clean", "--frame", "3", "--json"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(shown.json()["schema_version"], 1);
  EXPECT_EQ(shown.json()["screenshot"]["frame"], 3);
  EXPECT_EQ(readColourImage(at("view.png")).width_px, 480);
  EXPECT_THAT(shown.err, HasSubstr("the camera is unknown; shown with a free view"));
  EXPECT_EQ(screenshot({}).exit_code, 2) << "it is there already";
  EXPECT_EQ(screenshot({"--force"}).exit_code, 0);
}

TEST_F(View, OptionsReachTheMovieAndItsProgressIsShown) {
  const Outcome outcome = view({"--movie", at("view.mp4"), "--size", "320x240", "--fps", "10",
                                "--seconds", "0.4", "--turn", "60", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["movie"]["frames"], 4);
  EXPECT_THAT(outcome.err, HasSubstr("movie 4/4"));
}

TEST_F(View, BadRunsAreRefusedInOneLine) {
  expectRefused({"nowhere"}, run({"view", at("nowhere"), "--screenshot", at("x.png")}));
  fs::create_directories(at("empty"));
  expectRefused({"empty", "contains no model", "--wait"},
                run({"view", at("empty"), "--screenshot", at("x.png")}));
}

TEST_F(View, WrongOptionsAreNamed) {
  const auto wrong = [&](const std::vector<std::string>& options, const std::string& part) {
    const Outcome outcome = screenshot(options);
    EXPECT_EQ(outcome.exit_code, 2) << part << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
  };
  wrong({"--colour", "errors"}, "--reference or --evaluation");
  wrong({"--look", "sideways"}, "free, scope, front");
  wrong({"--turn", "1e9"}, "--turn");
  EXPECT_EQ(view({"--movie", at("a.mp4"), "--size", "401x300"}).exit_code, 2);
  EXPECT_EQ(view({"--clean"}).exit_code, 2) << "a window keeps its slider";
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

}  // namespace
}  // namespace softscope::test
