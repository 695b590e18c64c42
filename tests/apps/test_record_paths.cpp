// tests/apps/test_record_paths.cpp: records hold names and hashes, and paths only where asked.
#include "tests/apps/evaluate_fixture.h"
#include "toolkit/record/record_paths.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(RecordPaths, NamesStandForPathsInInputsAndTexts) {
  const FactSheet::Json record{
      {"command_line", {"reconstruct", "/mnt/jane/Doe Jane", "--out=/mnt/jane/run", "a>1"}},
      {"inputs",
       {{"left", {{"path", "/mnt/jane/Doe Jane/left"}, {"sha256", "ab/cd"}}},
        {"reference", "visits/doe/liver.stl"}}},
      {"runs", {"/mnt/jane/a/", "b"}},
      {"machine", {{"processor", "A /x/y"}}},
      {"configuration", {{"stereo.model", "/mnt/jane/net.onnx"}, {"calibration.unit", "a/b"}}},
      {"warnings",
       {"/mnt/jane/Doe Jane/left/3.png: is black", "visits/doe/liver.stl: has holes",
        "visits/doe/seen.ply: is empty", "it drifts by 0.1 mm/s"}}};
  const FactSheet::Json names = RecordPaths{}.applyTo(record);
  EXPECT_EQ(names["command_line"].dump(), R"(["reconstruct","Doe Jane","--out=run","a>1"])");
  EXPECT_EQ(names["inputs"]["left"]["path"], "left");
  EXPECT_EQ(names["inputs"]["left"]["sha256"], "ab/cd");
  EXPECT_EQ(names["inputs"]["reference"], "liver.stl");
  EXPECT_EQ(names["runs"], (FactSheet::Json{"a", "b"}));
  EXPECT_EQ(names["machine"], record["machine"]);
  EXPECT_EQ(names["configuration"]["stereo.model"], "net.onnx");
  EXPECT_EQ(names["configuration"]["calibration.unit"], "a/b");
  EXPECT_EQ(names["warnings"], (FactSheet::Json{"left/3.png: is black", "liver.stl: has holes",
                                                "seen.ply: is empty", "it drifts by 0.1 mm/s"}));
  EXPECT_EQ(RecordPaths{true}.applyTo(record), record);
}

class Records : public Evaluate {
 protected:
  /// Runs it without and with --keep-paths. The record names the folder in the second case alone,
  /// and is what --json prints.
  void expectPathsOnlyWhereAsked(std::vector<std::string> words, const std::string& record) {
    words.insert(words.end(), {"--json", "--quiet"});
    const Outcome names = run(words);
    ASSERT_EQ(names.exit_code, 0) << names.err;
    EXPECT_THAT(textOf(at(record)), Not(HasSubstr(folder.string()))) << words[0];
    EXPECT_EQ(Json::parse(textOf(at(record))), names.json());
    words.insert(words.end(), {"--keep-paths", "--force"});
    const Outcome paths = run(words);
    ASSERT_EQ(paths.exit_code, 0) << paths.err;
    EXPECT_THAT(textOf(at(record)), HasSubstr(folder.string())) << words[0];
  }
};

TEST_F(Records, EveryCommandWritesPathsOnlyWhereAsked) {
  const std::string clip = makeSequence("Doe Jane", 2);
  expectPathsOnlyWhereAsked({"reconstruct", clip, "--out", at("r")}, "r/run.json");
  expectPathsOnlyWhereAsked({"depth", clip, "--out", at("d")}, "d/summary.json");
  expectPathsOnlyWhereAsked({"evaluate", at("run"), "--reference", at("truth"), "--out", at("e")},
                            "e/evaluation.json");
  write("flat.obj", "v 0 0 50\nv 9 0 50\nv 0 9 50\nf 1 2 3\n");
  expectPathsOnlyWhereAsked(
      {"compare", "--reference", at("flat.obj"), "--test", at("flat.obj"), "--out", at("c")},
      "c/comparison.json");
  expectPathsOnlyWhereAsked({"slice", "--surface", at("flat.obj"), "--out", at("s.svg")}, "s.json");
  expectPathsOnlyWhereAsked(
      {"figure", at("run"), "--reference", at("truth"), "--kind", "series", "--out", at("f.svg")},
      "f.json");
}

TEST_F(Records, EveryCommandSaysWhatItWrote) {
  const std::string clip = makeSequence("clip", 2);
  write("flat.obj", "v 0 0 50\nv 9 0 50\nv 0 9 50\nf 1 2 3\n");
  const std::string flat = at("flat.obj");
  const std::vector<std::vector<std::string>> lines{
      {"reconstruct", clip, "--out", at("r")},
      {"depth", clip, "--out", at("d")},
      {"evaluate", at("run"), "--reference", at("truth"), "--out", at("e")},
      {"compare", "--reference", flat, "--test", flat, "--out", at("c")},
      {"slice", "--surface", flat, "--out", at("s.svg")},
      {"figure", at("run"), "--reference", at("truth"), "--kind", "series", "--out", at("f.svg")},
      {"report", at("e"), "--out", at("p.html")},
      {"export", flat, "--out", at("m.stl")},
      {"simulate", "--out", at("made"), "--frames", "2", "--size", "96x80", "--set",
       "organ.cells_per_side=16"},
      {"calibration-template", "rectified", "--out", at("t.yaml")}};
  for (const std::vector<std::string>& line : lines) {
    const Outcome done = run(line);
    ASSERT_EQ(done.exit_code, 0) << line[0] << ": " << done.err;
    const auto out = std::find(line.begin(), line.end(), "--out");
    EXPECT_THAT(done.out + done.err, HasSubstr(*(out + 1))) << line[0];
  }
}

TEST_F(Records, HashesTellWhatWasCompared) {
  write("flat.obj", "v 0 0 50\nv 9 0 50\nv 0 9 50\nf 1 2 3\n");
  const Json compared =
      run({"compare", "--reference", at("flat.obj"), "--test", at("flat.obj"), "--json"}).json();
  EXPECT_EQ(compared["inputs"]["test"], "flat.obj");
  EXPECT_EQ(compared["inputs_sha256"]["test"].get<std::string>().size(), 64u);
  write("run/run.json", "{}");
  const Json evaluated =
      run({"evaluate", at("run"), "--reference", at("flat.obj"), "--json"}).json();
  EXPECT_EQ(evaluated["inputs"]["reference"], "flat.obj");
  EXPECT_EQ(evaluated["inputs_sha256"]["reference"], compared["inputs_sha256"]["reference"]);
  EXPECT_EQ(evaluated["inputs_sha256"]["run"].get<std::string>().size(), 64u);
}

TEST_F(Records, TheWarningOfOtherImagesIsComplete) {
  const std::string clip = makeSequence("clip", 2);
  for (const char* side : {"left", "right"}) fs::copy(clip + "/" + side, at("truth") + "/" + side);
  write("run/run.json", R"({"inputs": {"left": {"sha256": "00"}}})");
  EXPECT_EQ(evaluated()["warnings"][0],
            "truth/left: the run was made from other images; a run of another sequence?");
}

TEST_F(Records, ARunWithoutPathsIsJudgedAndReported) {
  const std::string clip = makeSequence("clip", 2);
  ASSERT_EQ(run({"reconstruct", clip, "--out", at("r"), "--quiet"}).exit_code, 0);
  EXPECT_EQ(run({"evaluate", at("r"), "--reference", clip, "--out", at("e"), "--quiet"}).exit_code,
            0);
  EXPECT_EQ(run({"report", at("e"), "--out", at("p.html")}).exit_code, 0);
}

}  // namespace
}  // namespace softscope::test
