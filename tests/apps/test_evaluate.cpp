// tests/apps/test_evaluate.cpp: `softscope evaluate` on a run whose errors are known.
#include <cmath>

#include "io/geometry/ply_writer.h"
#include "io/images/image_writer.h"
#include "tests/apps/evaluate_fixture.h"
#include "toolkit/run/table_reader.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(Evaluate, SurfaceErrorsAreThoseThatWereMade) {
  const Json surface = evaluated()["surface"];
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

TEST_F(Evaluate, EveryFrameHasItsOwnErrors) {
  const Json frames = evaluated()["frames"];
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

TEST_F(Evaluate, DriftAndJitterAreThoseOfTheMeanError) {
  const Json result = evaluated();
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

TEST_F(Evaluate, TheScopesPathIsOffByWhatItWasMovedDown) {
  const Json camera = evaluated()["camera"];
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

TEST_F(Evaluate, TracksAreJudgedInTheCamerasFrameBesideTheControl) {
  const Json tracks = evaluated()["tracks"];
  EXPECT_NEAR(tracks["mean_mm"], 0.5, kFloats) << "the pose's own error must not count";
  EXPECT_NEAR(tracks["max_mm"], 0.5, kFloats);
  double control = 0;
  for (int k = 0; k < kFrames; ++k) control += k * std::hypot(0.3, 0.5) / kFrames;
  EXPECT_NEAR(tracks["no_motion_control_mm"], control, kFloats);
  EXPECT_EQ(tracks["reported"], 1);
  EXPECT_EQ(tracks["hidden"]["n"], kFrames);
  EXPECT_EQ(tracks["visible"]["n"], 3 * kFrames);
}

TEST_F(Evaluate, WithoutDepthFilesTheTrueMeshIsLookedAt) {
  const Json with_files = evaluated();
  fs::remove_all(at("truth/groundtruth/depth"));
  const Json without = evaluated();
  for (const char* part : {"observed", "predicted"})
    EXPECT_EQ(without["surface"][part]["n"], with_files["surface"][part]["n"]) << part;
  EXPECT_EQ(without["surface"]["completeness_1mm"], with_files["surface"]["completeness_1mm"]);
}

TEST_F(Evaluate, ARunThatBeganLaterIsJudgedByItsOwnFrames) {
  fs::remove_all(at("run"));
  makeWallRun(at("run"), kFrames, /*first=*/2);
  const Outcome outcome = evaluate({"--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json result = outcome.json();
  EXPECT_EQ(result["frames"][0]["frame"], 2);
  EXPECT_NEAR(result["frames"][1]["observed_mean_mm"], 0.16, kFloats);
  EXPECT_NEAR(result["frames"][1]["pose_error_mm"], 0.1, kFloats) << "from its own first frame on";
  EXPECT_NEAR(result["tracks"]["mean_mm"], 0.5, kFloats);
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("4 of the sequence's 6 frames"));
}

TEST_F(Evaluate, MissingTissueIsCounted) {
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

TEST_F(Evaluate, TheDrawnModelIsComparedWithDepthAndPicture) {
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
  EXPECT_TRUE(evaluate({"--no-views", "--json"}).json()["depth"]["mean_mm"].is_null());
}

TEST_F(Evaluate, TheRunsOwnBackProjectionIsHandedOn) {
  write("run/frames.csv", "frame,backprojection_mean_mm\n0,0.1\n1,\n2,0.3\n3,\n4,\n5,\n");
  const Json result = evaluated();
  EXPECT_NEAR(result["backprojection"]["mean_mm"], 0.2, 1e-12);
  EXPECT_TRUE(result["frames"][1]["backprojection_mean_mm"].is_null());
}

TEST_F(Evaluate, WritesNumbersTablesAndFigures) {
  const Outcome outcome = evaluate({"--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json(), Json::parse(textOf(at("out/evaluation.json"))));
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

TEST_F(Evaluate, TheSameInputsGiveTheSameBytes) {
  ASSERT_EQ(evaluate({"--out", at("one"), "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(evaluate({"--out", at("two")}).exit_code, 0);
  for (const char* file : {"evaluation.json", "frames.csv", "tracks.csv", "error_series.svg",
                           "error_series.pdf", "error_series.png", "error_histogram.pdf"})
    EXPECT_EQ(textOf(at(std::string("one/") + file)), textOf(at(std::string("two/") + file)))
        << file;
}

TEST_F(Evaluate, NothingIsOverwrittenWithoutForce) {
  write("out/frames.csv", "mine");
  const Outcome refused = evaluate({"--out", at("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(countFiles(at("out")), 1);
  EXPECT_EQ(evaluate({"--out", at("out"), "--force"}).exit_code, 0);
}

TEST_F(Evaluate, LimitsSetTheExitCode) {
  EXPECT_EQ(evaluate({"--fail-if", "p95_mm>2"}).exit_code, 0);
  const Outcome failed = evaluate({"--fail-if", "p95_mm>2", "--fail-if", "tracks.mean_mm >= 0.4"});
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.err, HasSubstr("tracks.mean_mm is 0.5"));
  EXPECT_THAT(failed.out, HasSubstr("surface")) << "the result is told all the same";
  EXPECT_EQ(evaluate({"--fail-if", "completeness_1mm<0.9"}).exit_code, 0);
}

TEST_F(Evaluate, WhatWasNotMeasuredPassesNoLimit) {
  fs::remove(at("run/tracks.csv"));
  const Outcome outcome = evaluate({"--fail-if", "tracks.mean_mm>2"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("not measured"));
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

TEST_F(Evaluate, AgainstAMeshTheLastModelIsCompared) {
  const std::string mesh = at("truth/groundtruth/mesh/000005.ply");
  const Outcome outcome =
      softscope::test::run({"evaluate", at("run"), "--reference", mesh, "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json result = outcome.json();
  EXPECT_EQ(result["surface"]["models_judged"], 1);
  EXPECT_NEAR(result["surface"]["max_mm"], 0.4, kFloats);
  EXPECT_NEAR(result["surface"]["median_mm"], 0.4, kFloats) << "most of the model isn't in view";
  EXPECT_EQ(result["comparison"]["alignment"], "none");
  EXPECT_FALSE(result.contains("tracks"));
}

TEST_F(Evaluate, AgainstAMeshTheModelOfAFrameIsComparedWhereAsked) {
  const std::string mesh = at("truth/groundtruth/mesh/000002.ply");
  const auto judged = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line{"evaluate", at("run"), "--reference", mesh, "--json"};
    line.insert(line.end(), more.begin(), more.end());
    return softscope::test::run(line);
  };
  const Outcome outcome = judged({"--frame", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["surface"]["models_judged"], 1);
  EXPECT_NEAR(outcome.json()["surface"]["max_mm"], 2 * (0.1 + 0.02 * 2), kFloats);
  EXPECT_EQ(judged({"--frame", "77"}).exit_code, 2);
  EXPECT_EQ(judged({"--frame", "2", "--each"}).exit_code, 2);
  EXPECT_EQ(evaluate({"--frame", "2"}).exit_code, 2) << "a sequence has its own frames";
}

TEST_F(Evaluate, AnAlignmentToAMeshIsToldWithTheErrorsBefore) {
  const std::string mesh = at("truth/groundtruth/mesh/000000.ply");
  for (const auto& [how, alignments] : std::vector<std::pair<std::string, std::size_t>>{
           {"none", 0}, {"rigid", 1}, {"icp", kFrames}}) {
    const Outcome outcome = softscope::test::run(
        {"evaluate", at("run"), "--reference", mesh, "--each", "--align", how, "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json result = outcome.json();
    EXPECT_EQ(result["comparison"]["alignments"].size(), alignments) << how;
    // The wall comes nearer by 0.5 mm a frame: unaligned, that shows in full; aligned once, too;
    // aligned each time, not at all.
    const double drift = result["surface"]["drift_mm_per_frame"];
    if (how == "icp")
      EXPECT_LT(drift, 0.02);
    else
      EXPECT_NEAR(drift, 0.53, 0.02) << how;
    if (alignments == 0) continue;
    const Json& first = result["comparison"]["alignments"][0];
    EXPECT_NEAR(first["before"]["mean_mm"], 0.2 - 0.1 * 57 * 43 / (81 * 81), kFloats)
        << "57 x 43 of 81 x 81 points are in view";
    EXPECT_LT(first["after"]["mean_mm"], first["before"]["mean_mm"]);
  }
}

TEST_F(Evaluate, AMeshInMetresIsSuspectedAndCanBeSaid) {
  std::string obj;
  for (const char* corner : {"-0.09 -0.09", "0.09 -0.09", "0.09 0.09", "-0.09 0.09"})
    obj += std::string("v ") + corner + " 0.0475\n";
  const std::string mesh = write("metres.obj", obj + "f 1 3 2\nf 1 4 3\n");
  const auto line = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"evaluate", at("run"), "--reference", mesh, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return softscope::test::run(words).json();
  };
  EXPECT_THAT(line({})["warnings"].dump(), HasSubstr("metres"));
  EXPECT_NEAR(line({"--reference-unit-mm", "1000"})["surface"]["max_mm"], 0.4, kFloats);
}

TEST_F(Evaluate, ARunWithoutModelsStillHasItsPath) {
  fs::remove_all(at("run/models"));
  const Outcome outcome = evaluate({"--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json result = outcome.json();
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("no model was judged"));
  EXPECT_TRUE(result["surface"]["mean_mm"].is_null());
  EXPECT_NEAR(result["camera"]["rpe"]["mean_mm"], 0.1, kFloats);
  EXPECT_FALSE(fs::exists(at("out/error_series.svg"))) << "a figure of nothing";
}

}  // namespace
}  // namespace softscope::test
