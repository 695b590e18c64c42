// tests/toolkit/evaluation_test.cpp: a run whose errors are known.
#include <cmath>

#include "core/parallel.h"
#include "io/geometry/ply_writer.h"
#include "io/images/image_writer.h"
#include "tests/toolkit/evaluation_fixture.h"
#include "toolkit/run/table_reader.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The record of the run as it was made.
class EvaluationOfTheWall : public testing::Test {
 protected:
  static const Json& record() {
    static const Json json = [] {
      const TemporaryFolder folder;
      makeWallTruth(folder / "truth", kFrames, /*with_depth=*/true);
      makeWallRun(folder / "run", kFrames);
      EvaluateOptions options;
      options.run = folder / "run";
      options.reference = folder / "truth";
      return written(evaluateRun(options).record);
    }();
    return json;
  }
};

TEST_F(EvaluationOfTheWall, SurfaceErrorsAreThoseThatWereMade) {
  const Json& surface = record()["surface"];
  // Observed points are off by 0.1 … 0.2 mm, 0.02 more a frame; their share falls as the wall comes
  // nearer, so their pooled mean lies a little below the middle of the frames' 0.15.
  EXPECT_NEAR(surface["observed"]["mean_mm"], 0.15, 0.003);
  EXPECT_NEAR(surface["observed"]["max_mm"], 0.2, kFloats);
  EXPECT_NEAR(surface["predicted"]["mean_mm"], 0.30, 0.003);
  EXPECT_NEAR(surface["signed"]["mean_mm"], surface["mean_mm"], kFloats)
      << "+ is the camera's side";
  EXPECT_EQ(surface["models_judged"], kFrames);
  EXPECT_EQ(surface["worst_frame"], kFrames - 1);
  EXPECT_EQ(surface["n"], 81 * 81 * kFrames);
  EXPECT_EQ(surface["completeness_1mm"], 1);
  EXPECT_EQ(surface["not_reconstructed_share"], 0);
}

TEST_F(EvaluationOfTheWall, EveryFrameHasItsOwnErrors) {
  const Json& frames = record()["frames"];
  ASSERT_EQ(frames.size(), unsigned(kFrames));
  for (int k = 0; k < kFrames; ++k) {
    const Json& frame = frames[std::size_t(k)];
    EXPECT_EQ(frame["frame"], k);
    EXPECT_NEAR(frame["observed_mean_mm"], 0.1 + 0.02 * k, kFloats);
    EXPECT_NEAR(frame["observed_p95_mm"], 0.1 + 0.02 * k, kFloats);
    EXPECT_NEAR(frame["predicted_mean_mm"], 0.2 + 0.04 * k, kFloats);
    EXPECT_NEAR(frame["pose_error_mm"], 0.1 * k, kFloats);
    EXPECT_NEAR(frame["track_mean_mm"], 0.5, kFloats);
  }
}

TEST_F(EvaluationOfTheWall, DriftAndJitterAreThoseOfTheMeanError) {
  const Json& result = record();
  std::vector<double> means_mm;
  for (const Json& frame : result["frames"]) means_mm.push_back(frame["mean_mm"]);
  // Means go from 0.2 - 0.1 * 57 * 43 / 81^2 = 0.163 mm (so many points are in view) to
  // 0.4 - 0.2 * 55 * 41 / 81^2 = 0.331 mm in five steps; in view, points come and go in rows.
  EXPECT_NEAR(result["surface"]["drift_mm_per_frame"], 0.0337, 0.001);
  EXPECT_NEAR(result["surface"]["drift_mm_per_s"],
              result["surface"]["drift_mm_per_frame"].get<double>() * 25, 1e-9);
  EXPECT_NEAR(result["frames"][2]["second_difference_mm"],
              means_mm[1] - 2 * means_mm[2] + means_mm[3], 1e-9);
  EXPECT_TRUE(result["frames"][0]["second_difference_mm"].is_null());
}

TEST_F(EvaluationOfTheWall, TheScopesPathIsOffByWhatItWasMovedDown) {
  const Json& camera = record()["camera"];
  double squares = 0;
  for (int k = 0; k < kFrames; ++k) squares += 0.01 * k * k;
  EXPECT_NEAR(camera["pose"]["rmse_mm"], std::sqrt(squares / kFrames), kFloats);
  EXPECT_NEAR(camera["pose"]["rmse_deg"], 0, 1e-6);
  EXPECT_NEAR(camera["rpe"]["mean_mm"], 0.1, kFloats);
  // A straight path that is turned a little: aligned, only its length differs, by sqrt(1.01).
  EXPECT_LT(camera["ate"]["rmse_mm"], 0.01);
  EXPECT_EQ(camera["ate_alignment"]["unique"], false) << "a straight path leaves a rotation free";
  EXPECT_TRUE(camera["ate"]["rmse_deg"].is_null());
}

TEST_F(EvaluationOfTheWall, TracksAreJudgedInTheCamerasFrameBesideTheControl) {
  const Json& tracks = record()["tracks"];
  EXPECT_NEAR(tracks["mean_mm"], 0.5, kFloats) << "the pose's own error must not count";
  EXPECT_NEAR(tracks["max_mm"], 0.5, kFloats);
  double control = 0;
  for (int k = 0; k < kFrames; ++k) control += k * std::hypot(0.3, 0.5) / kFrames;
  EXPECT_NEAR(tracks["no_motion_control_mm"], control, kFloats);
  EXPECT_EQ(tracks["reported"], 1);
  EXPECT_EQ(tracks["hidden"]["n"], kFrames);
  EXPECT_EQ(tracks["visible"]["n"], 3 * kFrames);
}

TEST_F(Evaluation, WithoutDepthFilesTheTrueMeshIsLookedAt) {
  const Json with_files = evaluated();
  fs::remove_all(at("truth/groundtruth/depth"));
  const Json without = evaluated();
  for (const char* part : {"observed", "predicted"})
    EXPECT_EQ(without["surface"][part]["n"], with_files["surface"][part]["n"]) << part;
  EXPECT_EQ(without["surface"]["completeness_1mm"], with_files["surface"]["completeness_1mm"]);
}

TEST_F(Evaluation, ARunThatBeganLaterIsJudgedByItsOwnFrames) {
  fs::remove_all(at("run"));
  makeWallRun(at("run"), kFrames, /*first=*/2);
  const Json result = evaluated();
  EXPECT_EQ(result["frames"][0]["frame"], 2);
  EXPECT_NEAR(result["frames"][1]["observed_mean_mm"], 0.16, kFloats);
  EXPECT_NEAR(result["frames"][1]["pose_error_mm"], 0.1, kFloats) << "from its own first frame on";
  EXPECT_NEAR(result["tracks"]["mean_mm"], 0.5, kFloats);
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("4 of the sequence's 6 frames"));
}

TEST_F(Evaluation, MissingTissueIsCounted) {
  for (int k = 0; k < kFrames; ++k) {
    PointCloud model = wallModel(k);
    PointCloud half;
    for (const auto& p : model.points_mm)
      if (p.x() < k) half.points_mm.push_back(p);  // the camera's left half
    writePly(at("run/models/00000" + std::to_string(k) + ".ply"), half, {"world", ""}, true);
  }
  // Points are 1 mm apart, so the half ends up to 1 mm left of the middle, and reaches 1 mm
  // farther. Tissue that both see spans columns 8 + disparity (14 to 15.5) to 151.
  EXPECT_NEAR(evaluated()["surface"]["completeness_1mm"], (80.0 - 23) / (152 - 23), 0.03);
}

TEST_F(Evaluation, TheDrawnModelIsComparedWithDepthAndPicture) {
  EXPECT_TRUE(evaluated()["view"]["psnr_db"].is_null()) << "no pictures, no likeness";
  for (int k = 0; k < kFrames; ++k)
    for (const char* side : {"left", "right"}) {
      fs::create_directories(at("truth") + "/" + side);
      writePng(at("truth") + "/" + side + "/00000" + std::to_string(k) + ".png",
               ColourImage(160, 120, Rgb8{210, 110, 100}));  // the model is 10 darker
    }
  const Json result = evaluated();
  EXPECT_NEAR(result["view"]["psnr_db"], 20 * std::log10(255.0 / 10), 0.1);
  EXPECT_EQ(result["view"]["judged_share"], 1) << "its points are three pixels apart: no gaps";
  EXPECT_EQ(result["view"]["psnr_over_all_pixels_db"], result["view"]["psnr_db"]);
  for (int k = 0; k < kFrames; ++k) {  // the aperture hides the left half
    ColourImage half(160, 120, Rgb8{210, 110, 100});
    for (int v = 0; v < 120; ++v)
      for (int u = 0; u < 80; ++u) half.at(u, v) = {0, 0, 0};
    writePng(at("truth/left/00000" + std::to_string(k) + ".png"), half, true);
  }
  const Json with_border = evaluated();
  EXPECT_NEAR(with_border["view"]["judged_share"], 1, 0.05)
      << "of the tissue, not of black borders";
  EXPECT_NEAR(with_border["view"]["psnr_db"], result["view"]["psnr_db"], 0.1);
  EXPECT_NEAR(double(with_border["view"]["psnr_over_all_pixels_db"]) -
                  double(with_border["view"]["psnr_db"]),
              10 * std::log10(2), 0.2)
      << "the same differences over twice the pixels";
  // 0.1 + 0.02 mm a frame too near; points at the rim, which stand for unseen tissue, twice that.
  EXPECT_NEAR(result["frames"][3]["depth_mean_mm"], 0.16, 0.01);
  EvaluateOptions undrawn = options();
  undrawn.views = false;
  EXPECT_TRUE(evaluated(undrawn)["depth"]["mean_mm"].is_null());
}

TEST_F(Evaluation, TheRunsOwnBackProjectionIsHandedOn) {
  write("run/frames.csv", "frame,backprojection_mean_mm\n0,0.1\n1,\n2,0.3\n3,\n4,\n5,\n");
  const Json result = evaluated();
  EXPECT_NEAR(result["backprojection"]["mean_mm"], 0.2, 1e-12);
  EXPECT_TRUE(result["frames"][1]["backprojection_mean_mm"].is_null());
}

TEST_F(Evaluation, WritesNumbersTablesAndFigures) {
  const RunEvaluation evaluation = evaluateInto("out");
  EXPECT_EQ(written(evaluation.record), Json::parse(textOf(at("out/evaluation.json"))));
  EXPECT_EQ(countFiles(at("out")), 19) << "temporary files stayed, or something lacks";
  EXPECT_THAT(textOf(at("out/error_series.svg")), HasSubstr(">run against truth</text>"));
  EXPECT_THAT(textOf(at("out/error_histogram.pdf")), testing::StartsWith("%PDF"));
  const NumberTable frames(textOf(at("out/frames.csv")), "frames.csv",
                           {"frame", "observed_mean_mm", "hd95_pooled_mm"}, {});
  ASSERT_EQ(frames.rows(), unsigned(kFrames));
  EXPECT_NEAR(frames.at(3, 1), 0.16, kFloats);
  const NumberTable tracks(textOf(at("out/tracks.csv")), "tracks.csv",
                           {"frame", "id", "error_mm", "no_motion_mm", "visible"}, {});
  EXPECT_EQ(tracks.rows(), unsigned(4 * kFrames));
}

TEST_F(Evaluation, TheSameInputsGiveTheSameBytes) {
  {
    const ThreadLimit one(1);
    evaluateInto("one");
  }
  evaluateInto("two");
  for (const char* file : {"evaluation.json", "frames.csv", "tracks.csv", "error_series.svg",
                           "error_series.pdf", "error_series.png", "error_histogram.pdf"})
    EXPECT_EQ(textOf(at(std::string("one/") + file)), textOf(at(std::string("two/") + file)))
        << file;
}

TEST_F(Evaluation, NothingIsOverwrittenUnlessAskedTo) {
  write("out/frames.csv", "mine");
  expectError<OptionError>([&] { EvaluateOutputs(at("out"), false); }, {"frames.csv"});
  EXPECT_EQ(countFiles(at("out")), 1);
  EXPECT_NO_THROW(EvaluateOutputs(at("out"), true).write(evaluate()));
  EXPECT_THAT(textOf(at("out/frames.csv")), testing::StartsWith("frame,"));
}

TEST_F(Evaluation, LimitsFailWhereTheyHold) {
  EvaluateOptions limited = options();
  limited.thresholds = limits({"p95_mm>2", "tracks.mean_mm >= 0.4", "completeness_1mm<0.9"});
  const std::vector<ThresholdOutcome> outcomes = evaluateRun(limited).outcomes;
  ASSERT_EQ(outcomes.size(), 3u);
  EXPECT_FALSE(outcomes[0].failed);
  EXPECT_TRUE(outcomes[1].failed);
  EXPECT_EQ(outcomes[1].path, "tracks.mean_mm");
  EXPECT_NEAR(outcomes[1].value, 0.5, kFloats);
  EXPECT_FALSE(outcomes[2].failed);
}

TEST_F(Evaluation, WhatWasNotMeasuredPassesNoLimit) {
  fs::remove(at("run/tracks.csv"));
  EvaluateOptions limited = options();
  limited.thresholds = limits({"tracks.mean_mm>2"});
  const ThresholdOutcome outcome = evaluateRun(limited).outcomes.at(0);
  EXPECT_TRUE(outcome.failed);
  EXPECT_TRUE(std::isnan(outcome.value));
}

TEST_F(Evaluation, AMisspeltLimitIsToldBeforeTheWork) {
  fs::remove_all(at("run"));  // else it would be an InputError
  for (const auto& [limit, told] : std::vector<std::pair<std::string, std::string>>{
           {"p59_mm>2", "did you mean `surface.p95_mm`"},
           {"camera.ate.p95_mn>2", "camera.ate.p95_mm"}}) {
    EvaluateOptions limited = options();
    limited.thresholds = limits({limit});
    expectError<OptionError>([&] { evaluateRun(limited); }, {told});
  }
}

TEST_F(Evaluation, AgainstAMeshTheLastModelIsCompared) {
  const Json result = evaluated(against(at("truth/groundtruth/mesh/000005.ply")));
  EXPECT_EQ(result["surface"]["models_judged"], 1);
  EXPECT_NEAR(result["surface"]["max_mm"], 0.4, kFloats);
  EXPECT_NEAR(result["surface"]["median_mm"], 0.4, kFloats) << "most of the model isn't in view";
  EXPECT_EQ(result["comparison"]["alignment"], "none");
  EXPECT_FALSE(result.contains("tracks"));
}

TEST_F(Evaluation, AgainstAMeshTheModelOfAFrameIsComparedWhereAsked) {
  EvaluateOptions of_frame = against(at("truth/groundtruth/mesh/000002.ply"));
  of_frame.frame = 2;
  const Json result = evaluated(of_frame);
  EXPECT_EQ(result["surface"]["models_judged"], 1);
  EXPECT_NEAR(result["surface"]["max_mm"], 2 * (0.1 + 0.02 * 2), kFloats);
  of_frame.frame = 77;
  expectError<OptionError>([&] { evaluateRun(of_frame); }, {"77"});
  of_frame.frame = 2;
  of_frame.each_model = true;
  expectError<OptionError>([&] { evaluateRun(of_frame); }, {"`frame=`"});
  EvaluateOptions sequence = options();
  sequence.frame = 2;
  expectError<OptionError>([&] { evaluateRun(sequence); }, {"a sequence"});  // has its own frames
}

TEST_F(Evaluation, AnAlignmentToAMeshIsToldWithTheErrorsBefore) {
  for (const auto& [how, alignments] : std::vector<std::pair<MeshAlignment, std::size_t>>{
           {MeshAlignment::kNone, 0}, {MeshAlignment::kRigid, 1}, {MeshAlignment::kIcp, kFrames}}) {
    SCOPED_TRACE(toString(how));
    EvaluateOptions aligned = against(at("truth/groundtruth/mesh/000000.ply"));
    aligned.each_model = true;
    aligned.alignment = how;
    const Json result = evaluated(aligned);
    EXPECT_EQ(result["comparison"]["alignments"].size(), alignments);
    // The wall comes nearer by 0.5 mm a frame: unaligned, that shows in full; aligned once, too;
    // aligned each time, not at all.
    const double drift = result["surface"]["drift_mm_per_frame"];
    if (how == MeshAlignment::kIcp)
      EXPECT_LT(drift, 0.02);
    else
      EXPECT_NEAR(drift, 0.53, 0.02);
    if (alignments == 0) continue;
    const Json& first = result["comparison"]["alignments"][0];
    EXPECT_NEAR(first["before"]["mean_mm"], 0.2 - 0.1 * 57 * 43 / (81 * 81), kFloats)
        << "57 x 43 of 81 x 81 points are in view";
    EXPECT_LT(first["after"]["mean_mm"], first["before"]["mean_mm"]);
  }
}

TEST_F(Evaluation, AMeshInMetresIsSuspectedAndCanBeSaid) {
  std::string obj;
  for (const char* corner : {"-0.09 -0.09", "0.09 -0.09", "0.09 0.09", "-0.09 0.09"})
    obj += std::string("v ") + corner + " 0.0475\n";
  EvaluateOptions metres = against(write("metres.obj", obj + "f 1 3 2\nf 1 4 3\n"));
  EXPECT_THAT(evaluated(metres)["warnings"].dump(), HasSubstr("metres"));
  metres.reference_unit_mm = 1000;
  EXPECT_NEAR(evaluated(metres)["surface"]["max_mm"], 0.4, kFloats);
}

TEST_F(Evaluation, ARunWithoutModelsStillHasItsPath) {
  fs::remove_all(at("run/models"));
  const Json result = written(evaluateInto("out").record);
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("no model was evaluated"));
  EXPECT_TRUE(result["surface"]["mean_mm"].is_null());
  EXPECT_NEAR(result["camera"]["rpe"]["mean_mm"], 0.1, kFloats);
  EXPECT_FALSE(fs::exists(at("out/error_series.svg"))) << "a figure of nothing";
}

}  // namespace
}  // namespace softscope::test
