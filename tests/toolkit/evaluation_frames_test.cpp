// tests/toolkit/evaluation_frames_test.cpp: frames of a run that its evaluation counts.
#include <algorithm>
#include <sstream>

#include "io/images/image_reader.h"
#include "tests/toolkit/evaluation_fixture.h"
#include "tests/toolkit/made_sequences.h"
#include "toolkit/report/write_report.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The page that a report of the evaluation in this folder makes.
std::string pageOf(const std::string& evaluation) {
  ReportOptions options;
  options.cases = {evaluation};
  options.html = evaluation + "/page.html";
  writeReport(options);
  return textOf(options.html);
}

/// Of six frames the run loses the fourth to the sixth, and then repeats what it knew.
class EvaluationLost : public Evaluation {
 protected:
  void SetUp() override {
    Evaluation::SetUp();
    write("run/frames.csv",
          "frame,status,backprojection_mean_mm,coverage,reason\n0,started,0,0.5,\n"
          "1,fused,0.2,0.5,\n2,fused,0.4,0.5,\n3,lost,,0.5,\"no pose, nowhere\"\n"
          "4,unconfirmed,0.1,0.5,\n5,lost,,0.5,\n");
  }
};

TEST_F(EvaluationLost, NothingIsCountedFromFramesThatWereNotFused) {
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

TEST_F(EvaluationLost, EveryOutputBeginsWithTheFrames) {
  const std::string told = evaluateInto("out").facts.text();
  const std::size_t frames = told.find("3 of 6 fused, 1 skipped, 2 lost");
  ASSERT_NE(frames, std::string::npos) << told;
  EXPECT_LT(frames, told.find("surface"));
  EXPECT_THAT(told, HasSubstr("###LsL"));
  EXPECT_THAT(textOf(at("out/frames.csv")), testing::StartsWith("frame,time_s,outcome,"));
  EXPECT_THAT(textOf(at("out/frames.csv")), HasSubstr("\n4,0.16,skipped,"));
  for (const char* name : {"error_series.svg", "error_histogram.svg", "worst_frames.svg"})
    EXPECT_THAT(textOf(at(std::string("out/") + name)), HasSubstr(">3 fused of 6 frames<")) << name;
  const std::string page = pageOf(at("out"));
  const std::size_t said = page.find("Of 6 frames 3 were fused, 1 skipped, 2 lost.");
  ASSERT_NE(said, std::string::npos);
  EXPECT_LT(said, page.find("The frames over time."));
  EXPECT_LT(page.find("The frames over time."), page.find("Mean distance"));
}

TEST_F(EvaluationLost, AShareOfTheFramesIsALimit) {
  EvaluateOptions limited = options();
  limited.thresholds = limits({"lost>30%", "lost>40%"});
  const auto outcomes = evaluateRun(limited).outcomes;
  EXPECT_TRUE(outcomes.at(0).failed);
  EXPECT_FALSE(outcomes.at(1).failed);
}

TEST_F(EvaluationLost, AStatusThatNoFrameCanHaveIsRefused) {
  write("run/frames.csv", "frame,status\n0,started\n1,fused\n2,fsued\n3,lost\n4,lost\n5,lost\n");
  expectRefused({"frames.csv", "line 4", "fsued"});
}

TEST_F(Evaluation, ARunThatWasStoppedIsCalledSo) {
  EXPECT_EQ(evaluated()["warnings"].dump().find("was stopped"), std::string::npos);
  write("run/checkpoint.bin", "left by a run that was killed");
  EXPECT_THAT(evaluated()["warnings"].dump(), HasSubstr("was stopped or killed, or is in progress: "
                                                        "its last frame is 5"));
}

TEST_F(Evaluation, AClipWithoutTimestampsHasFramesOnEveryAxis) {
  for (const char* file : {"truth/groundtruth/trajectory.txt", "run/trajectory.txt"}) {
    std::string lines;
    for (int k = 0; k < kFrames; ++k) lines += std::to_string(k) + " 0 0 0 0 0 0 1\n";
    write(file, lines);
  }
  const Json result = written(evaluateInto("out").record);
  EXPECT_TRUE(result["surface"]["drift_mm_per_s"].is_null());
  EXPECT_FALSE(result["surface"]["drift_mm_per_frame"].is_null());
  EXPECT_TRUE(result["frames"][2]["time_s"].is_null());
  EXPECT_THAT(textOf(at("out/error_series.svg")), HasSubstr(">frame<"));
  EXPECT_THAT(textOf(at("out/error_series.svg")), testing::Not(HasSubstr("time [s]")));
  const std::string page = pageOf(at("out"));
  EXPECT_THAT(page, testing::Not(HasSubstr("time [s]")));
  EXPECT_THAT(page, testing::Not(HasSubstr("mm/s")));
}

/// The lines of these numbers.
std::string chosenLines(const std::string& text, const std::vector<int>& numbers) {
  std::istringstream all(text);
  std::string line, kept;
  for (int k = 0; std::getline(all, line); ++k)
    if (std::count(numbers.begin(), numbers.end(), k) != 0) kept += line + "\n";
  return kept;
}

TEST_F(Evaluation, TruePosesBelongToTheFramesOfTheirTimes) {
  write("truth/timestamps.txt", "0\n0.04\n0.08\n0.12\n0.16\n0.2\n");
  const Json whole = evaluated();
  const std::string truth = "truth/groundtruth/trajectory.txt";
  write(truth, chosenLines(textOf(at(truth)), {0, 1, 3, 5}));  // its title, frames 0, 2, 4
  const Json some = evaluated();
  EXPECT_EQ(whole["camera"]["poses"], 6);
  EXPECT_EQ(some["camera"]["poses"], 3);
  EXPECT_NEAR(some["camera"]["pose"]["mean_mm"].get<double>(), 0.2, kFloats);  // 0, 0.2, 0.4
  for (const std::size_t frame : {0u, 2u, 4u})
    for (const char* value :
         {"time_s", "mean_mm", "depth_mean_mm", "pose_error_mm", "track_mean_mm"})
      EXPECT_EQ(some["frames"][frame][value], whole["frames"][frame][value]) << value;
  EXPECT_TRUE(some["frames"][1]["pose_error_mm"].is_null());
  EXPECT_THAT(some["warnings"].dump(), HasSubstr("3 frames of the run have no true pose"));
  EXPECT_EQ(whole["tracks"]["reported"], 1);
  EXPECT_EQ(some["tracks"]["reported"], 1) << "of the frames with a true pose";
  EXPECT_EQ(some["tracks"]["without_truth"], 0);
}

TEST_F(Evaluation, AMissingFirstTruePoseHidesNoError) {
  write("truth/timestamps.txt", "0\n0.04\n0.08\n0.12\n0.16\n0.2\n");
  const std::string truth = "truth/groundtruth/trajectory.txt";
  write(truth, chosenLines(textOf(at(truth)), {0, 2, 4}));  // its title, frames 1, 3
  const Json result = evaluated();
  EXPECT_EQ(result["camera"]["poses"], 2);
  EXPECT_NEAR(result["camera"]["pose"]["mean_mm"].get<double>(), 0.2, kFloats);  // 0.1, 0.3
}

TEST_F(Evaluation, ATruePoseBetweenTheFramesIsRefused) {
  write("truth/timestamps.txt", "0\n0.04\n0.08\n0.12\n0.16\n0.2\n");
  write("truth/groundtruth/trajectory.txt", "0 0 0 0 0 0 0 1\n0.05 0 0 0 0 0 0 1\n");
  expectRefused({"trajectory.txt", "0.05 s", "timestamps.txt", "2 poses of 6 frames"});
}

TEST_F(Evaluation, TheWorldOfARunBeginsWithItsFirstFusedFrame) {
  fs::remove_all(at("run"));
  makeWallRun(at("run"), kFrames, 1);
  const Json later = evaluated();
  write("run/trajectory.txt", "0 0 0 0 0 0 0 1\n" + textOf(at("run/trajectory.txt")));
  write("run/frames.csv",
        "frame,status\n0,skipped_depth\n1,started\n2,fused\n3,fused\n4,fused\n5,fused\n");
  const Json skipped = evaluated();
  EXPECT_EQ(skipped["camera"]["pose"], later["camera"]["pose"]);
  EXPECT_EQ(skipped["camera"]["poses"], 5);
}

class EvaluationWithoutTruth : public InFolder {
 protected:
  static EvaluateOptions optionsOf(const std::string& run, const std::string& sequence) {
    EvaluateOptions options;
    options.run = run;
    options.reference = sequence;
    return options;
  }
};

TEST_F(EvaluationWithoutTruth, ALostFramesStepIsNone) {
  const std::string clip = makeSequence("clip", 6);
  makeWallRun(at("run"), 6);
  fs::remove_all(at("run/models"));
  std::string table = "frame,status,backprojection_mean_mm,coverage\n0,started,0,0.8\n";
  for (int k = 1; k < 6; ++k)
    table += std::to_string(k) + (k < 3 ? ",fused,0.2,0.6\n" : ",lost,,0.1\n");
  write("run/frames.csv", table);
  const Json record = written(evaluateRun(optionsOf(at("run"), clip)).record);
  EXPECT_EQ(record["camera"]["step"]["n"], 2);
  EXPECT_EQ(record["camera"]["poses"], 3);
  EXPECT_EQ(record["backprojection"]["n"], 2);
  EXPECT_NEAR(record["coverage"]["mean_share"], 2.0 / 3, 1e-9) << "of the three fused frames";
  EXPECT_TRUE(record["frames"][4]["step_mm"].is_null());
}

TEST_F(EvaluationWithoutTruth, MeasuresWhatNeedsNoneAndSaysWhatIsMissing) {
  const SlopeRun& made = slopeRun();
  const EvaluateOptions options = optionsOf(made.run, made.sequence);
  const RunEvaluation evaluation = evaluateRun(options);
  EvaluateOutputs(at("out"), false).write(evaluation);
  const Json record = written(evaluation.record);
  EXPECT_EQ(record["comparison"]["reference_kind"], "pictures");
  EXPECT_EQ(record["view"]["models_judged"], 4);
  EXPECT_GT(record["view"]["psnr_db"], 20) << "the model was coloured by these pictures";
  EXPECT_GT(record["view"]["ssim"], 0.5);
  EXPECT_LT(record["backprojection"]["mean_mm"], 0.5);
  const Json run = Json::parse(textOf(made.run + "/run.json"));
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
  const std::string told = evaluation.facts.text();
  EXPECT_THAT(told, HasSubstr("no ground truth"));
  const std::size_t frames = told.find("4 of 4 fused, 0 skipped, 0 lost");
  ASSERT_NE(frames, std::string::npos) << told;
  EXPECT_LT(frames, told.find("PSNR"));
  EXPECT_THAT(told, HasSubstr("####  # fused"));
  EXPECT_THAT(told, HasSubstr("groundtruth/tracks.csv"));
  ReportOptions report;
  report.cases = {at("out")};
  report.html = at("page.html");
  report.thresholds = limits({"psnr_db<20"});
  const ReportDocument document = writeReport(report);
  EXPECT_FALSE(document.outcomes.at(0).failed);
  EXPECT_EQ(written(document.metrics)["cases"][0]["record"]["view"], record["view"]);
  const std::string page = textOf(at("page.html"));
  for (const char* part :
       {"There is no ground truth", ">PSNR [dB]<", "camera step [mm]", "Of 4 frames 4 were fused",
        "4 fused of 4 frames", "rendered after the fusion of a frame, minus the"})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST_F(EvaluationWithoutTruth, WithoutACalibrationThereAreNoViews) {
  const std::string clip = makeSequence("clip", 4);
  fs::remove(clip + "/calibration.yaml");
  makeWallRun(at("run"), 4);
  const Json record = written(evaluateRun(optionsOf(at("run"), clip)).record);
  EXPECT_EQ(record["camera"]["step"]["n"], 3);
  EXPECT_EQ(record["view"]["models_judged"], 0);
  EXPECT_THAT(record["warnings"].dump(), HasSubstr("Without a calibration no model is rendered"));
}

TEST_F(EvaluationWithoutTruth, LimitsAreOfWhatNeedsNone) {
  EvaluateOptions limited = optionsOf(slopeRun().run, slopeRun().sequence);
  limited.thresholds = limits({"psnr_db<99"});
  EXPECT_TRUE(evaluateRun(limited).outcomes.at(0).failed);
  limited.thresholds = limits({"p95_mm>1"});
  expectError<OptionError>([&] { evaluateRun(limited); }, {"p95_mm"});
  EXPECT_THROW(limits({"p95_mm>1 mm"}), OptionError);
}

}  // namespace
}  // namespace softscope::test
