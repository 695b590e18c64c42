// tests/apps/test_evaluate_frames.cpp: which frames of a run its evaluation counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "io/images/image_reader.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Of six frames the run loses the fourth to the sixth, and then repeats what it knew.
class EvaluateLost : public Evaluate {
 protected:
  void SetUp() override {
    Evaluate::SetUp();
    write("run/frames.csv",
          "frame,status,backprojection_mean_mm,coverage,reason\n0,started,0,0.5,\n"
          "1,fused,0.2,0.5,\n2,fused,0.4,0.5,\n3,lost,,0.5,\"no pose, nowhere\"\n"
          "4,unconfirmed,0.1,0.5,\n5,lost,,0.5,\n");
  }
};

TEST_F(EvaluateLost, NothingIsCountedFromFramesThatWereNotFused) {
  const Json result = evaluated();
  EXPECT_EQ(result["outcomes"]["frames"], 6);
  EXPECT_EQ(result["outcomes"]["fused"], 3);
  EXPECT_EQ(result["outcomes"]["skipped"], 1);
  EXPECT_EQ(result["outcomes"]["lost"], 2);
  EXPECT_EQ(result["outcomes"]["lost_share"], 2.0 / 6);
  EXPECT_EQ(result["surface"]["models_judged"], 3);
  EXPECT_EQ(result["camera"]["poses"], 3);
  EXPECT_EQ(result["camera"]["rpe"]["n"], 2);
  EXPECT_EQ(result["tracks"]["n"], 3 * 4);
  EXPECT_NEAR(result["tracks"]["reported"], 0.5, 1e-12);
  EXPECT_EQ(result["backprojection"]["n"], 2) << "the first frame's zero is no measurement";
  EXPECT_NEAR(result["backprojection"]["mean_mm"], 0.3, 1e-12);
  ASSERT_EQ(result["frames"].size(), 6u);
  EXPECT_EQ(result["frames"][3]["outcome"], "lost");
  EXPECT_TRUE(result["frames"][3]["mean_mm"].is_null());
}

TEST_F(EvaluateLost, EveryOutputBeginsWithTheFrames) {
  const Outcome told = evaluate({"--out", at("out")});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const std::size_t frames = told.out.find("3 of 6 fused, 1 skipped, 2 lost");
  ASSERT_NE(frames, std::string::npos) << told.out;
  EXPECT_LT(frames, told.out.find("surface"));
  EXPECT_THAT(told.out, HasSubstr("###LsL"));
  EXPECT_THAT(textOf(at("out/frames.csv")), testing::StartsWith("frame,time_s,outcome,"));
  EXPECT_THAT(textOf(at("out/frames.csv")), HasSubstr("\n4,0.16,skipped,"));
  for (const char* name : {"error_series.svg", "error_histogram.svg", "worst_frames.svg"})
    EXPECT_THAT(textOf(at(std::string("out/") + name)), HasSubstr(">3 fused of 6 frames<")) << name;
  ASSERT_EQ(softscope::test::run({"report", at("out"), "--out", at("page.html")}).exit_code, 0);
  const std::string page = textOf(at("page.html"));
  const std::size_t said = page.find("Of 6 frames 3 were fused, 1 skipped, 2 lost.");
  ASSERT_NE(said, std::string::npos);
  EXPECT_LT(said, page.find("The frames over time."));
  EXPECT_LT(page.find("The frames over time."), page.find("Mean distance"));
  EXPECT_EQ(evaluate({"--fail-if", "lost>30%"}).exit_code, 1);
  EXPECT_EQ(evaluate({"--fail-if", "lost>40%"}).exit_code, 0);
}

TEST_F(EvaluateLost, AStatusThatNoFrameCanHaveIsRefused) {
  write("run/frames.csv", "frame,status\n0,started\n1,fused\n2,fsued\n3,lost\n4,lost\n5,lost\n");
  expectRefused({"frames.csv", "line 4", "fsued"}, evaluate());
}

TEST_F(Evaluate, ARunThatWasStoppedIsCalledSo) {
  EXPECT_EQ(evaluated()["warnings"].dump().find("was stopped"), std::string::npos);
  write("run/checkpoint.bin", "left by a run that was killed");
  EXPECT_THAT(evaluated()["warnings"].dump(), HasSubstr("was stopped, killed, or is not over: its "
                                                        "last frame is 5"));
}

TEST_F(Evaluate, AClipWithoutTimestampsHasFramesOnEveryAxis) {
  for (const char* file : {"truth/groundtruth/trajectory.txt", "run/trajectory.txt"}) {
    std::string lines;
    for (int k = 0; k < kFrames; ++k) lines += std::to_string(k) + " 0 0 0 0 0 0 1\n";
    write(file, lines);
  }
  const Outcome outcome = evaluate({"--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.json()["surface"]["drift_mm_per_s"].is_null());
  EXPECT_FALSE(outcome.json()["surface"]["drift_mm_per_frame"].is_null());
  EXPECT_TRUE(outcome.json()["frames"][2]["time_s"].is_null());
  EXPECT_THAT(textOf(at("out/error_series.svg")), HasSubstr(">frame<"));
  EXPECT_THAT(textOf(at("out/error_series.svg")), testing::Not(HasSubstr("time [s]")));
  ASSERT_EQ(softscope::test::run({"report", at("out"), "--out", at("page.html")}).exit_code, 0);
  EXPECT_THAT(textOf(at("page.html")), testing::Not(HasSubstr("time [s]")));
  EXPECT_THAT(textOf(at("page.html")), testing::Not(HasSubstr("mm/s")));
}

class EvaluateWithoutTruth : public InFolder {};

TEST_F(EvaluateWithoutTruth, ALostFramesStepIsNone) {
  const std::string clip = makeSequence("clip", 6);
  makeWallRun(at("run"), 6);
  fs::remove_all(at("run/models"));
  std::string table = "frame,status,backprojection_mean_mm,coverage\n0,started,0,0.8\n";
  for (int k = 1; k < 6; ++k)
    table += std::to_string(k) + (k < 3 ? ",fused,0.2,0.6\n" : ",lost,,0.1\n");
  write("run/frames.csv", table);
  const Outcome outcome =
      softscope::test::run({"evaluate", at("run"), "--reference", clip, "--json", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json record = outcome.json();
  EXPECT_EQ(record["camera"]["step"]["n"], 2);
  EXPECT_EQ(record["camera"]["poses"], 3);
  EXPECT_EQ(record["backprojection"]["n"], 2);
  EXPECT_NEAR(record["coverage"]["mean_share"], 2.0 / 3, 1e-9) << "of the three fused frames";
  EXPECT_TRUE(record["frames"][4]["step_mm"].is_null());
}

TEST_F(EvaluateWithoutTruth, MeasuresWhatNeedsNoneAndSaysWhatIsMissing) {
  const std::string clip = makeSequence("clip", 4);
  ASSERT_EQ(softscope::test::run({"reconstruct", clip, "--out", at("run"), "--save-every", "1",
                                  "--set", "stereo.disparity_max_px=63", "--quiet"})
                .exit_code,
            0);
  const std::vector<std::string> line{"evaluate", at("run"), "--reference", clip,
                                      "--out",    at("out"), "--force",     "--quiet"};
  std::vector<std::string> as_json = line;
  as_json.emplace_back("--json");
  const Outcome outcome = softscope::test::run(as_json);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json record = outcome.json();
  EXPECT_EQ(record["comparison"]["reference_kind"], "pictures");
  EXPECT_EQ(record["view"]["models_judged"], 4);
  EXPECT_GT(record["view"]["psnr_db"], 20) << "the model was coloured by these pictures";
  EXPECT_GT(record["view"]["ssim"], 0.5);
  EXPECT_LT(record["backprojection"]["mean_mm"], 0.5);
  const Json run = Json::parse(textOf(at("run/run.json")));
  EXPECT_NEAR(record["backprojection"]["mean_mm"], run["mean_backprojection_mm"], 1e-4)
      << "frames.csv has four digits";
  EXPECT_EQ(record["outcomes"], run["outcomes"]);
  EXPECT_GT(record["coverage"]["mean_share"], 0.5);
  EXPECT_EQ(record["camera"]["step"]["n"], 3) << "three steps between four poses";
  EXPECT_GE(record["missing"].size(), 4u);
  EXPECT_FALSE(record.contains("surface")) << "no number that would need truth";
  const std::string csv = textOf(at("out/frames.csv"));
  EXPECT_THAT(csv, testing::StartsWith("frame,time_s,outcome,view_psnr_db"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_EQ(record["drawn_view"]["frame"], 3);
  EXPECT_EQ(record["drawn_view"]["age_frames"], 0);
  EXPECT_EQ(record["view"]["pixels"],
            "pixels that the model covers, without masks and black borders");
  const ColourImage drawn = readColourImage(at("out/drawn_view.png"));
  EXPECT_EQ(drawn.width_px, 160 + 4 + 160) << "image, gap, model";
  for (const char* name : {"quality_series.svg", "quality_series.pdf", "quality_series.png"})
    EXPECT_TRUE(fs::exists(at(std::string("out/") + name))) << name;
  const std::string series = textOf(at("out/quality_series.svg"));
  ASSERT_NE(series.find(">4 fused of 4 frames<"), std::string::npos);
  EXPECT_LT(series.find(">4 fused of 4 frames<"), series.find(">PSNR [dB]<"));
  for (const char* letter : {">(a)<", ">(b)<"})
    EXPECT_THAT(textOf(at("out/quality_series.svg")), HasSubstr(letter));
  EXPECT_THAT(textOf(at("out/quality_series.svg")), HasSubstr(">frame<"))
      << "the clip has no clock";
  const Outcome told = softscope::test::run(line);
  EXPECT_THAT(told.out, HasSubstr("no ground truth"));
  const std::size_t frames = told.out.find("4 of 4 fused, 0 skipped, 0 lost");
  ASSERT_NE(frames, std::string::npos) << told.out;
  EXPECT_LT(frames, told.out.find("PSNR"));
  EXPECT_THAT(told.out, HasSubstr("####  # fused"));
  EXPECT_THAT(told.out, HasSubstr("groundtruth/tracks.csv"));
  std::vector<std::string> limited = line;
  limited.insert(limited.end(), {"--fail-if", "psnr_db<99"});
  EXPECT_EQ(softscope::test::run(limited).exit_code, 1);
  limited.back() = "p95_mm>1 mm";
  EXPECT_EQ(softscope::test::run(limited).exit_code, 2);
  const Outcome report = softscope::test::run(
      {"report", at("out"), "--out", at("page.html"), "--json", "--fail-if", "psnr_db<20"});
  ASSERT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.json()["cases"][0]["record"]["view"], record["view"]);
  const std::string page = textOf(at("page.html"));
  for (const char* part :
       {"There is no ground truth", ">PSNR [dB]<", "s step [mm]", "Of 4 frames 4 were fused",
        "4 fused of 4 frames", "drawn into that frame, minus the"})
    EXPECT_THAT(page, HasSubstr(part));
}

}  // namespace
}  // namespace softscope::test
