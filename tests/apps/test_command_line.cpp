// tests/apps/test_command_line.cpp: help, misspelt words, exit codes.
#include <gmock/gmock.h>

#include "apps/option_names.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class EveryCommand : public testing::TestWithParam<const char*> {};

TEST_P(EveryCommand, HelpsOnStdoutWithAnExample) {
  const Outcome help = run({GetParam(), "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr(std::string("example:\n  softscope ") + GetParam()));
  EXPECT_THAT(help.out, HasSubstr("--json"));
  EXPECT_EQ(help.err, "");
}

TEST_P(EveryCommand, KnowsTheNearestOption) {
  const Outcome outcome = run({GetParam(), "--jsn"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean `--json`?"));
  EXPECT_EQ(outcome.out, "") << "stdout carries results alone";
}

INSTANTIATE_TEST_SUITE_P(Apps, EveryCommand,
                         testing::Values("reconstruct", "depth", "simulate", "calibrate",
                                         "evaluate", "export", "info", "doctor"),
                         [](const auto& command) { return std::string(command.param); });

TEST(CommandLine, OverviewListsEveryCommand) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* name : {"reconstruct", "depth", "simulate", "calibrate", "evaluate", "export",
                           "info", "doctor", "example:"})
    EXPECT_THAT(help.out, HasSubstr(name));
  EXPECT_EQ(run({"help", "depth"}).out, run({"depth", "--help"}).out);
}

TEST(CommandLine, TellsItsVersion) {
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(run({"-V"}).out, version.out);
  EXPECT_THAT(version.out, testing::MatchesRegex("softscope [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, MisspeltCommandGetsTheNearestName) {
  const Outcome outcome = run({"docter"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("did you mean `doctor`?"));
}

TEST(CommandLine, AnEmptyOutputIsNamed) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"simulate", "--out", ""},
                                                {"calibration-template", "rectified", "--out", ""},
                                                {"depth", "left.png", "right.png", "--out", ""}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("softscope " + words[0] + ": --out is empty"));
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(CommandLine, AFarFetchedCommandGetsNoGuess) {
  EXPECT_THAT(run({"xyzzy"}).err, Not(HasSubstr("did you mean")));
}

TEST(CommandLine, WrongUsageIsExitCodeTwoAndOneLine) {
  const std::vector<std::vector<std::string>> lines{
      {},
      {"depth"},
      {"depth", "a", "b", "c", "--out", "x"},
      {"depth", "a", "b", "--out"},
      {"depth", "a.png", "b.png", "--out", "x"},  // no calibration
      {"info"},
      {"doctor", "--threads", "many"},
      {"doctor", "--threads", "-1"},
      {"doctor", "--quiet", "--verbose"},
      {"depth", "a", "--out", "x", "--frames", "9:3"},
      {"depth", "a", "--out", "x", "--range", "80:40"},
      {"depth", "a", "--out", "x", "--frame", "middle"},
      {"depth", "a", "--out", "x", "--write", "dpth"}};
  for (const auto& line : lines) {
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(line);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("error: "));
  }
}

TEST(CommandLine, ColoursAreAMatterOfTheOption) {
  const std::string escape = "\033[";
  EXPECT_THAT(run({"info", "/absent", "--color", "always"}).err, HasSubstr(escape));
  EXPECT_THAT(run({"info", "/absent", "--color", "never"}).err, testing::Not(HasSubstr(escape)));
  EXPECT_THAT(run({"info", "/absent"}).err, testing::Not(HasSubstr(escape))) << "no terminal";
  const Outcome wrong = run({"info", "/absent", "--color", "sometimes"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("auto, always or never"));
}

TEST(CommandLine, MisspeltSettingGetsTheNearestKey) {
  const Outcome outcome = run({"depth", "a", "--out", "x", "--set", "stereo.methd=sgbm"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("stereo.method"));
}

TEST(CommandLine, AnOptionOutOfItsRangeIsNamed) {
  const Outcome outcome = run({"depth", "a", "--out", "x", "--set", "stereo.method=magic"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--set: stereo.method is magic, expected elas, sgbm or onnx"));
}

TEST(CommandLine, SettingsInErrorsBecomeOptions) {
  for (const auto& [message, told] : std::vector<std::pair<std::string, std::string>>{
           {"`save_every=` is -1, but can't be negative",
            "--save-every is -1, but can't be negative"},
           {"a: exists. Choose another name or give `overwrite=`",
            "a: exists. Choose another name or give --force"},
           {"`each_model=` and `dots_per_inch=`: 2", "--each and --dpi: 2"},
           {"`kind=` is `frames`, but must be four", "--kind is `frames`, but must be four"},
           {"a.csv: has no column `frame`", "a.csv: has no column `frame`"},
           {"`stereo.method=sgbm`, `elsewhere=`, one ` alone, `frame=",
            "`stereo.method=sgbm`, `elsewhere=`, one ` alone, `frame="},
           {"", ""}})
    EXPECT_EQ(withOptions(message), told);
  const Outcome outcome = run({"export", "/absent", "--out", "a.ply", "--unit", "inch"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--unit is `inch`, but must be mm, cm or m"));
}

TEST(CommandLine, SettingsAreListedWithRangeUnitAndMeaning) {
  const Outcome table = run({"settings"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out,
              testing::ContainsRegex("fusion.max_weight +10 +1 or more +largest weight"));
  const Outcome json = run({"settings", "--preset", "paper", "--json"});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_THAT(json.out, HasSubstr("\"key\": \"deform.node_model\""));
  EXPECT_THAT(json.out, HasSubstr("\"default\": \"affine\""));
  const Outcome scenario = run({"settings", "simulate", "--toml"});
  EXPECT_EQ(scenario.exit_code, 0) << scenario.err;
  EXPECT_THAT(scenario.out, HasSubstr("to the tissue: 5 to 500 mm\ncamera.distance_mm = "));
  const Outcome both = run({"settings", "--toml", "--json"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("--toml"));
}

}  // namespace
}  // namespace softscope::test
