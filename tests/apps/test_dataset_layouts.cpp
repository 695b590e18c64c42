// tests/apps/test_dataset_layouts.cpp: clips of STIR 2026, run and judged by `softscope benchmark`.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "io/datasets/stir_files.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class DatasetLayouts : public InFolder {
 protected:
  Outcome simulate(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> words{"simulate", "--out", at(out), "--size", "176x132", "--quiet"};
    for (const char* setting : {"instrument.radius_mm=2", "organ.cells_per_side=30"})
      words.insert(words.end(), {"--set", setting});
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(DatasetLayouts, StirClipsAreRecognisedRunAndJudgedAsOurOwn) {
  ASSERT_EQ(simulate("data/seq_1", {"--layout", "stir2026", "--frames", "6"}).exit_code, 0);
  const Outcome own =
      simulate("own", {"--set", "pictures=mp4", "--set", "masks=false", "--frames", "6"});
  ASSERT_EQ(own.exit_code, 0) << own.err;
  for (const char* name : {"left.mp4", "right.mp4"})  // an encoder's bytes depend on its threads
    fs::copy_file(at("data/seq_1/") + name, at("own/") + name,
                  fs::copy_options::overwrite_existing);

  const Outcome info = run({"info", at("data/seq_1"), "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(info.json()["dataset"], "STIR 2026");
  EXPECT_EQ(info.json()["dataset_truth"].size(), 2u);
  EXPECT_EQ(info.json()["frames"], 6);

  const StirAnnotations truth = readStirAnnotations(at("data/seq_1/annotations.json"));
  ASSERT_EQ(truth.size(), 6u);
  EXPECT_EQ(readStirQueries(at("data/seq_1/queries.json")).size(), truth.at(0).size());

  const Outcome benchmark =
      run({"benchmark", "stir2026", at("data"), "--out", at("b"), "--json", "--quiet"});
  ASSERT_EQ(benchmark.exit_code, 0) << benchmark.err;
  const auto json = benchmark.json();
  EXPECT_EQ(json["clips"].size(), 1u);
  EXPECT_TRUE(json["excluded"].empty());
  EXPECT_GT(json["scores_3d"]["ata"], 0.8);
  EXPECT_EQ(json["scores_3d"]["points"], 5 * truth.at(0).size());  // the first frame is left out
  EXPECT_TRUE(json["control_3d"]["aj"].is_number());
  const auto predictions = nlohmann::json::parse(std::ifstream(at("b/preds.json")));
  ASSERT_EQ(predictions["seq_1"].size(), 6u);
  EXPECT_EQ(predictions["seq_1"]["3"]["coords"].size(), truth.at(0).size());
  EXPECT_LT(predictions["seq_1"]["3"]["coords"][0][2], 0.3);  // metres

  // The same clip in the form of softscope, the same tracked pixels, evaluated by `evaluate`.
  ASSERT_EQ(run({"reconstruct", at("own"), "--track", at("b/clips/seq_1/points.csv"), "--out",
                 at("run"), "--quiet"})
                .exit_code,
            0);
  const Outcome evaluated =
      run({"evaluate", at("run"), "--reference", at("own"), "--out", at("e"), "--json", "--quiet"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const auto tracks = evaluated.json()["tracks"];
  // In the form of softscope, truth is rounded to 1e-4 mm.
  EXPECT_NEAR(json["measured_error"]["mean_mm"].get<double>(), tracks["mean_mm"].get<double>(),
              0.0005)
      << tracks;

  const auto before = fs::last_write_time(at("b/clips/seq_1/run/run.json"));
  EXPECT_EQ(run({"benchmark", "stir2026", at("data"), "--out", at("b"), "--quiet"}).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(at("b/clips/seq_1/run/run.json")), before) << "it was run again";

  fs::copy(at("data/seq_1"), at("data/seq_2"));
  std::ofstream(at("data/seq_2/annotations.json")) << "{\"0/0\":";
  const Outcome broken =
      run({"benchmark", "stir2026", at("data"), "--out", at("b"), "--json", "--quiet"});
  ASSERT_EQ(broken.exit_code, 0) << broken.err;
  EXPECT_EQ(broken.json()["excluded"][0]["clip"], "seq_2");
}

TEST_F(DatasetLayouts, WhatCannotBeIsOneLine) {
  const auto fails = [&](const Outcome& outcome, int code, const std::string& text) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  fails(simulate("a", {"--layout", "stir2027"}), 2, "did you mean `stir2026`");
  fails(simulate("a", {"--layout", "scared", "--truth", "mesh"}), 2, "--truth");
  fs::create_directories(at("full"));
  std::ofstream(at("full/file")) << "x";
  fails(simulate("full", {"--layout", "scared"}), 2, "not empty");
  fails(run({"benchmark", "stir2026", at("full"), "--out", at("b"), "--quiet"}), 3, "no clip");
  fails(run({"benchmark", "scard", at("full"), "--out", at("b")}), 2, "stir2026");
}

}  // namespace
}  // namespace softscope::test
