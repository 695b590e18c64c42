// tests/apps/test_interrupt.cpp: Ctrl-C ends long work cleanly.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

class Interrupt : public InFolder {};

void waitFor(const fs::path& file) {
  for (int i = 0; i < 1000 && !fs::exists(file); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST_F(Interrupt, FinishedFramesAndTheirSummaryStay) {
  const std::string sequence = makeSequence("s", 1);
  for (int i = 1; i < 400; ++i) {  // far more than are done when the signal comes
    const std::string name = "/00" + std::to_string(1000 + i) + ".png";
    fs::create_hard_link(sequence + "/left/000000.png", sequence + "/left" + name);
    fs::create_hard_link(sequence + "/right/000000.png", sequence + "/right" + name);
  }
  const std::string out = at("out");
  const pid_t child = fork();
  if (child == 0) {
    execl(executable().c_str(), "softscope", "depth", sequence.c_str(), "--out", out.c_str(),
          "--write", "disparity,depth,confidence,cloud,picture", "--quiet", nullptr);
    _exit(127);
  }
  waitFor(out + "/000001_picture.png");
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  const auto json = nlohmann::json::parse(std::ifstream(out + "/summary.json"));
  EXPECT_TRUE(json["interrupted"]);
  const int done = json["frames_done"];
  EXPECT_GE(done, 2);
  EXPECT_LT(done, 400);
  EXPECT_EQ(countFiles(out), 7 * done + 1) << "half-written files stayed";
}

}  // namespace
}  // namespace softscope::test
