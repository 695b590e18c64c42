// tests/apps/test_evaluate.cpp: `softscope evaluate`: its options, its lines and its exit codes.
#include <cmath>

#include "core/raster.h"
#include "io/geometry/depth_files.h"
#include "io/images/image_writer.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(Evaluate, JsonOnStdoutIsTheRecordInTheFolder) {
  const Outcome outcome = evaluate({"--out", at("out"), "--json", "--no-views", "--threads", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json(), Json::parse(textOf(at("out/evaluation.json"))));
  EXPECT_TRUE(outcome.json()["depth"]["mean_mm"].is_null()) << "--no-views";
}

TEST_F(Evaluate, NothingIsOverwrittenWithoutForce) {
  write("out/frames.csv", "mine");
  const Outcome refused = evaluate({"--out", at("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(countFiles(at("out")), 1);
  EXPECT_EQ(evaluate({"--out", at("out"), "--force", "--no-views"}).exit_code, 0);
}

TEST_F(Evaluate, LimitsSetTheExitCode) {
  const Outcome failed =
      evaluate({"--no-views", "--fail-if", "p95_mm>2", "--fail-if", "tracks.mean_mm >= 0.4"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.err, HasSubstr("tracks.mean_mm is 0.5"));
  EXPECT_THAT(failed.out, HasSubstr("surface")) << "the result is told all the same";
  EXPECT_EQ(evaluate({"--no-views", "--fail-if", "p95_mm>2"}).exit_code, 0);
  fs::remove(at("run/tracks.csv"));
  const Outcome unknown = evaluate({"--no-views", "--fail-if", "tracks.mean_mm>2"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("not measured"));
}

TEST_F(Evaluate, AMisspeltLimitIsToldBeforeTheWork) {
  fs::remove_all(at("run"));  // else it would be exit code 3
  for (const auto& [limit, told] : std::vector<std::pair<std::string, std::string>>{
           {"p59_mm>2", "did you mean `surface.p95_mm`"},
           {"p95_mm", "a metric, one of > >= < <=, and a number"},
           {"p95_mm>two", "a number"},
           {"p95_mm=>2", "one of > >= < <="},
           {"camera.ate.p95_mn>2", "camera.ate.p95_mm"}}) {
    const Outcome outcome = evaluate({"--fail-if", limit});
    EXPECT_EQ(outcome.exit_code, 2) << limit;
    EXPECT_THAT(outcome.err, HasSubstr(told));
  }
}

TEST_F(Evaluate, OptionsOfAMeshReachTheEvaluation) {
  const std::string mesh = at("truth/groundtruth/mesh/000002.ply");
  const auto judged = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line{"evaluate", at("run"), "--reference", mesh, "--json"};
    line.insert(line.end(), more.begin(), more.end());
    return run(line);
  };
  const Json of_frame = judged({"--frame", "2"}).json();
  EXPECT_NEAR(of_frame["surface"]["max_mm"], 2 * (0.1 + 0.02 * 2), kFloats);
  const Json each = judged({"--each", "--align", "rigid"}).json();
  EXPECT_EQ(each["surface"]["models_judged"], kFrames);
  EXPECT_EQ(each["comparison"]["alignment"], "rigid");
  EXPECT_GT(judged({"--reference-unit-mm", "1000"}).json()["surface"]["mean_mm"], 1000);
  EXPECT_EQ(judged({"--frame", "77"}).exit_code, 2);
  EXPECT_EQ(judged({"--frame", "2", "--each"}).exit_code, 2);
  EXPECT_EQ(judged({"--align", "best"}).exit_code, 2);
}

TEST_F(Evaluate, OptionsThatMakeNoSenseAreUsageErrors) {
  EXPECT_EQ(evaluate({"--align", "icp"}).exit_code, 2) << "a sequence needs no alignment";
  EXPECT_EQ(evaluate({"--each"}).exit_code, 2);
  EXPECT_EQ(evaluate({"--frame", "2"}).exit_code, 2) << "a sequence has its own frames";
  EXPECT_EQ(run({"evaluate", at("run")}).exit_code, 2);
  write("file", "x");
  EXPECT_EQ(evaluate({"--out", at("file")}).exit_code, 2);
}

TEST_F(Evaluate, BadInputEndsInOneLine) {
  expectRefused({at("nowhere")}, run({"evaluate", at("nowhere"), "--reference", at("truth")}));
  write("run/frames.csv", "frame,status\n0,started\n1,fused\n2,fsued\n3,lost\n4,lost\n5,lost\n");
  expectRefused({"frames.csv", "line 4", "fsued"}, evaluate());
  fs::remove(at("run/frames.csv"));
  fs::resize_file(at("run/models/000003.ply"), 3000);
  expectRefused({"000003.ply", "truncated"}, evaluate());
}

/// Frames that the run did not fuse.
TEST_F(Evaluate, TellsFirstWhatBecameOfTheFrames) {
  write("run/frames.csv",
        "frame,status\n0,started\n1,fused\n2,fused\n3,lost\n4,unconfirmed\n5,lost\n");
  const Outcome told = evaluate({"--no-views", "--fail-if", "lost>30%"});
  EXPECT_EQ(told.exit_code, 1);
  const std::size_t frames = told.out.find("3 of 6 fused, 1 skipped, 2 lost");
  ASSERT_NE(frames, std::string::npos) << told.out;
  EXPECT_LT(frames, told.out.find("surface"));
  EXPECT_THAT(told.out, HasSubstr("###LsL"));
  EXPECT_EQ(evaluate({"--no-views", "--fail-if", "lost>40%"}).exit_code, 0);
}

class EvaluateMaps : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    writePfm(at("000000_disparity.pfm"), Raster<float>(40, 20, 20.25f));
    writePfm(at("map.pfm"), Raster<float>(40, 20, 20.25f));
    writePfm(at("truth.pfm"), Raster<float>(40, 20, 20.0f));
  }
  Outcome evaluate(const std::string& map, std::vector<std::string> more) const {
    more.insert(more.begin(), {"evaluate", at(map), "--reference", at("truth.pfm")});
    return run(more);
  }
};

TEST_F(EvaluateMaps, OptionsReachTheEvaluation) {
  makeWallTruth(at("clip"), 1, false);
  writePng(at("confidence.png"), GrayImage(40, 20, 230));
  const Outcome outcome =
      evaluate("map.pfm", {"--map", "disparity", "--calibration", at("clip/calibration.yaml"),
                           "--confidence", at("confidence.png"), "--json", "--out", at("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(outcome.json()["disparity"]["epe_px"], 0.25, 1e-6);
  EXPECT_GT(outcome.json()["depth"]["mae_mm"], 0);
  EXPECT_EQ(outcome.json()["sigma"]["within_95_share"], 1);
  EXPECT_EQ(Json::parse(textOf(at("out/evaluation.json"))), outcome.json());
}

TEST_F(EvaluateMaps, LimitsAndMistakesAreTold) {
  EXPECT_EQ(evaluate("000000_disparity.pfm", {"--fail-if", "epe_px>0.2"}).exit_code, 1);
  EXPECT_EQ(evaluate("000000_disparity.pfm", {"--fail-if", "epe>0.2"}).exit_code, 2);
  EXPECT_EQ(evaluate("000000_disparity.pfm", {"--align", "icp"}).exit_code, 2);
  const Outcome unnamed = evaluate("map.pfm", {});
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_THAT(unnamed.err, HasSubstr("--map"));
  writeDepthPng(at("000000_depth.png"), Raster<float>(40, 20, 50.0f));
  const Outcome foreign = run({"evaluate", at("000000_disparity.pfm"), "--reference",
                               at("000000_depth.png"), "--map", "disparity"});
  EXPECT_EQ(foreign.exit_code, 3) << foreign.out;
  EXPECT_THAT(foreign.err, HasSubstr("is named a depth map"));
}

}  // namespace
}  // namespace softscope::test
