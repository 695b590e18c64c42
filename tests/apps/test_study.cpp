// tests/apps/test_study.cpp: `softscope study` from a file to a table.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Simulated clips of two frames, 160 x 120: half a second a case.
const std::string kSimulated =
    "[simulate]\nframes = 2\nscope.width_px = 160\nscope.height_px = 120\n"
    "organ.cells_per_side = 20\ntruth_every = 1\n"
    "[reconstruct]\nstereo.disparity_max_px = 63\nsave_every = 1\n";

class StudyCommand : public InFolder {
 protected:
  Outcome study(const std::string& toml, std::vector<std::string> more = {}) const {
    std::vector<std::string> line{"study", write("study.toml", toml), "--out", at("out"),
                                  "--quiet"};
    line.insert(line.end(), more.begin(), more.end());
    return run(line);
  }
  /// Of two frames that exist and have no truth: the fastest cases.
  std::string small() const {
    return "sequence = '" + makeSequence("clip", 2) +
           "'\n[reconstruct]\nstereo.disparity_max_px = 63\nsave_every = 0\n";
  }
  nlohmann::json result() const { return nlohmann::json::parse(textOf(at("out/study.json"))); }
  nlohmann::json record(const std::string& name) const {
    return nlohmann::json::parse(textOf(at("out/cases/" + name + "/case.json")));
  }
};

TEST_F(StudyCommand, RunsItsCasesAndWritesTheTable) {
  const Outcome done =
      study(kSimulated +
            "[[variant]]\nname = 'surf'\n"
            "[[variant]]\nname = 'loose'\nreconstruct.deform.correspondence_weight "
            "= 0.0\n");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto json = result();
  ASSERT_EQ(json["cases"].size(), 2u);
  for (const auto& one : json["cases"]) {
    EXPECT_EQ(one["status"], "done");
    EXPECT_GT(one["evaluation"]["tracks"]["n"], 0) << "material points were judged";
  }
  EXPECT_THAT(done.out, HasSubstr("| surf |"));
  EXPECT_EQ(textOf(at("out/table.md")), done.out.substr(0, done.out.find("\nwritten to")));
  for (const char* name :
       {"table.csv", "report.html", "plots/points.svg", "plots/points.pdf", "cases/surf/log.txt",
        "cases/surf/run/model.ply", "cases/surf/evaluation/evaluation.json"})
    EXPECT_TRUE(fs::exists(at("out/" + std::string(name)))) << name;
  int sequences = 0;
  for (const auto& entry : fs::directory_iterator(at("out/sequences")))
    sequences += entry.is_directory();
  EXPECT_EQ(sequences, 1) << "both variants look at the same clip";
}

TEST_F(StudyCommand, RunsACaseAgainOnlyWhereItsSettingsChanged) {
  const std::string clip = small(), cases = "[[case]]\nname = 'a'\n[[case]]\nname = 'b'\n";
  ASSERT_EQ(study(clip + cases).exit_code, 0);
  const auto a = fs::last_write_time(at("out/cases/a/case.json"));
  const auto b = fs::last_write_time(at("out/cases/b/case.json"));
  ASSERT_EQ(study("# a remark changes nothing\n" + clip + cases).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(at("out/cases/b/case.json")), b);
  ASSERT_EQ(study(clip + cases + "reconstruct.fusion.max_weight = 5\n").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(at("out/cases/a/case.json")), a);
  EXPECT_NE(fs::last_write_time(at("out/cases/b/case.json")), b);
}

TEST_F(StudyCommand, AFailedCaseIsToldAndDoesNotStopTheOthers) {
  write("empty/left/notes.txt", "no picture");
  const std::string toml = small() +
                           "[[case]]\nname = 'broken'\nsequence = 'empty'\n"
                           "[[case]]\nname = 'absent'\nsequence = 'nowhere'\n"
                           "[[case]]\nname = 'fine'\n";
  const Outcome done = study(toml);
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_THAT(done.err, HasSubstr("broken: reconstruct: "));
  EXPECT_EQ(record("broken")["status"], "failed");
  EXPECT_EQ(record("absent")["status"], "skipped");
  EXPECT_EQ(record("fine")["status"], "done");
  EXPECT_THAT(textOf(at("out/table.md")), HasSubstr("- absent: nowhere is not here"));
}

TEST_F(StudyCommand, OneCaseAloneAndTheTableAfterwards) {
  const std::string toml = small() + "[[case]]\nname = 'a'\n[[case]]\nname = 'b'\n";
  const Outcome names = run({"study", write("s.toml", toml), "--list"});
  EXPECT_EQ(names.out, "a\nb\n");
  const auto list = run({"study", at("s.toml"), "--list", "--json"}).json();
  EXPECT_EQ(list["schema_version"], 1);
  EXPECT_EQ(list["cases"], (std::vector<std::string>{"a", "b"}));
  const Outcome alone = study(toml, {"--case", "a", "--json"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(alone.json(), record("a"));
  EXPECT_FALSE(fs::exists(at("out/study.json")));
  EXPECT_EQ(study(toml, {"--table"}).exit_code, 1) << "b is still to be run";
  EXPECT_EQ(result()["cases"][0]["status"], "done");
  EXPECT_EQ(result()["cases"][1]["status"], "not run");
}

// A table of old numbers with new settings would be misleading.
TEST_F(StudyCommand, TheTableLeavesOutWhatWasRunWithOtherSettings) {
  const std::string toml = small() + "[[case]]\nname = 'a'\n[[case]]\nname = 'b'\n";
  ASSERT_EQ(study(toml).exit_code, 0);
  const Outcome changed = study(toml + "reconstruct.fusion.max_weight = 5\n", {"--table"});
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_THAT(changed.err, HasSubstr("b: its settings or inputs changed"));
  EXPECT_EQ(result()["cases"][0]["status"], "done");
  EXPECT_EQ(result()["cases"][1]["status"], "outdated");
  EXPECT_FALSE(result()["cases"][1].contains("run")) << "numbers of other settings";
  EXPECT_EQ(study(toml, {"--table"}).exit_code, 0);
  EXPECT_EQ(result()["cases"][1]["status"], "done");
}

TEST_F(StudyCommand, ADamagedRecordIsACaseThatWasNotRun) {
  const std::string cases = small() + "[[case]]\nname = 'a'\n";
  ASSERT_EQ(study(cases).exit_code, 0);
  const std::string file = at("out/cases/a/case.json"), sound = textOf(file);
  for (const auto& [what, with] :
       std::vector<std::pair<std::string, std::string>>{{"\"reason\": \"\"", "\"reason\": 5"},
                                                        {"\"status\": \"done\"", "\"status\": []"},
                                                        {"{", "["}}) {
    std::string damaged = sound;
    ASSERT_NE(damaged.find(what), std::string::npos) << what;
    write("out/cases/a/case.json", damaged.replace(damaged.find(what), what.size(), with));
    const Outcome table = study(cases, {"--table"});
    EXPECT_EQ(table.exit_code, 1) << table.err;
    EXPECT_THAT(table.err, HasSubstr("a: has not been run"));
  }
}

TEST_F(StudyCommand, NoFoldersOfTheMachineInWhatItShows) {
  write("clips of Jane Doe/broken/left/notes.txt", "no picture");
  const Outcome done =
      study("[[case]]\nname = 'broken'\nsequence = '" + at("clips of Jane Doe/broken") +
            "'\n[[case]]\nname = 'absent'\n" + "sequence = '" + at("no where") + "'\n");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_THAT(record("absent")["reason"], "no where is not here");
  for (const char* name : {"report.html", "table.md", "table.csv", "study.json",
                           "cases/broken/case.json", "cases/absent/case.json"}) {
    EXPECT_THAT(textOf(at("out/" + std::string(name))), testing::Not(HasSubstr(folder.string())))
        << name;
    EXPECT_THAT(textOf(at("out/" + std::string(name))), testing::Not(HasSubstr("Doe"))) << name;
  }
  EXPECT_THAT(textOf(at("out/report.html")),
              HasSubstr("<code>softscope study study.toml --out out</code>"));
}

TEST_F(StudyCommand, AKilledSimulationLeavesNoPart) {
  const std::string toml = kSimulated + "[[case]]\nname = 'a'\n";
  ASSERT_EQ(study(toml).exit_code, 0);
  for (const auto& entry : fs::directory_iterator(at("out/sequences")))
    if (entry.is_directory()) fs::rename(entry.path(), entry.path().string() + ".part-77");
  ASSERT_EQ(study(toml, {"--force"}).exit_code, 0);
  int folders = 0;
  for (const auto& entry : fs::directory_iterator(at("out/sequences")))
    folders += entry.is_directory() ? 1 : 0;
  EXPECT_EQ(folders, 1);
}

TEST_F(StudyCommand, ARecordNamesNoFolderOfItsInputs) {
  fs::create_directories(at("of Jane Doe"));
  fs::rename(makeSequence("clip", 2), at("of Jane Doe/clip"));
  const Outcome done = study("[[case]]\nname = 'a'\nsequence = '" + at("of Jane Doe/clip") +
                             "'\n[reconstruct]\nstereo.disparity_max_px = 63\nsave_every = 0\n");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(record("a")["status"], "done");
  for (const char* name : {"cases/a/case.json", "cases/a/run/run.json", "study.json"})
    EXPECT_THAT(textOf(at("out/" + std::string(name))),
                testing::AllOf(Not(HasSubstr("Doe")), Not(HasSubstr(folder.string()))))
        << name;
}

TEST_F(StudyCommand, WhatCannotBeIsOneLine) {
  const auto expectOneLine = [](const Outcome& outcome, const char* says) {
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(says));
  };
  expectOneLine(study("[[case]]\nname = 'heart'\n", {"--case", "haert"}), "did you mean `heart`");
  expectOneLine(study("[simulate]\nfrmes = 3\n"), "frames");
  expectOneLine(study("", {"--table", "--list"}), "exclude each other");
  expectOneLine(study(kSimulated, {"--table"}), "there is no study in");
  EXPECT_FALSE(fs::exists(at("out")));
  write("out/photograph.png", "mine");
  expectOneLine(study(kSimulated), "is no folder of a study");
}

// A foreign folder that happens to contain `cases`.
TEST_F(StudyCommand, LeavesFoldersOfOthersAlone) {
  write("out/cases/one.txt", "mine");
  write("out/plots/mine.txt", "mine");
  const Outcome refused = study(small());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("plots"));
  EXPECT_EQ(textOf(at("out/plots/mine.txt")), "mine");
}

// An ignored SIGCHLD is inherited; then waiting for a child is impossible.
TEST_F(StudyCommand, WaitsForItsCasesWhereItsParentIgnoresChildren) {
  const std::string file = write("study.toml", small()), out = at("out");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGCHLD, SIG_IGN);
    execl(executable().c_str(), "softscope", "study", file.c_str(), "--out", out.c_str(), "--quiet",
          nullptr);
    _exit(127);
  }
  int status = 0;
  pid_t ended = 0;
  for (int i = 0; i < 6000 && ended == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ended = waitpid(child, &status, WNOHANG);
  }
  if (ended == 0) kill(child, SIGKILL);
  ASSERT_EQ(ended, child) << "waits for ever";
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(record("case")["status"], "done");
}

TEST_F(StudyCommand, CtrlCStopsCleanlyAndTheSameLineGoesOn) {
  std::string toml = small();
  for (const char* name : {"a", "b", "c"}) toml += "[[case]]\nname = '" + std::string(name) + "'\n";
  const std::string file = write("study.toml", toml), out = at("out");
  const pid_t child = fork();
  if (child == 0) {
    execl(executable().c_str(), "softscope", "study", file.c_str(), "--out", out.c_str(), "--jobs",
          "1", "--quiet", nullptr);
    _exit(127);
  }
  for (int i = 0; i < 3000 && !fs::exists(out + "/cases/b"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(record("a")["status"], "done");
  EXPECT_FALSE(fs::exists(at("out/cases/c/case.json")));
  EXPECT_FALSE(fs::exists(at("out/study.json")));
  const auto a = fs::last_write_time(at("out/cases/a/case.json"));
  ASSERT_EQ(study(toml).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(at("out/cases/a/case.json")), a) << "what was done stays";
  EXPECT_EQ(record("c")["status"], "done");
}

}  // namespace
}  // namespace softscope::test
