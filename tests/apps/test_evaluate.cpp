// tests/apps/test_evaluate.cpp: `softscope evaluate` on a run whose errors are known.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "apps/evaluate_tables.h"
#include "io/atomic_file.h"
#include "io/depth_files.h"
#include "io/ply_writer.h"
#include "tests/apps/made_run.h"
#include "tests/apps/run_softscope.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::json;

constexpr int kFrames = 6;
constexpr double kFloats = 2e-5;  // floats near 100 mm, and text with 6 digits after the point

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class Evaluate : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    makeWallTruth(at("truth"), kFrames, /*with_depth=*/true);
    makeWallRun(at("run"), kFrames);
  }
  Outcome evaluate(std::vector<std::string> more = {}) const {
    std::vector<std::string> line{"evaluate", at("run"), "--reference", at("truth")};
    line.insert(line.end(), more.begin(), more.end());
    return softscope::test::run(line);
  }
  Json evaluated() const {
    const Outcome outcome = evaluate({"--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.json();
  }
  /// Expects exit code 3 and one line that holds all of `parts`.
  static void expectRefused(const std::vector<std::string>& parts, const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
    const std::string last = outcome.err.substr(outcome.err.find("error: "));  // after the progress
    EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  }
};

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

TEST_F(Evaluate, WritesNumbersTablesAndFigures) {
  const Outcome outcome = evaluate({"--out", at("out"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json(), Json::parse(textOf(at("out/evaluation.json"))));
  EXPECT_EQ(countFiles(at("out")), 9) << "temporary files stayed, or something lacks";
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

TEST_F(Evaluate, MissingPartsOfARunAreNamed) {
  expectRefused({at("nowhere")},
                softscope::test::run({"evaluate", at("nowhere"), "--reference", at("truth")}));
  expectRefused({"groundtruth/trajectory.txt", "missing"},
                softscope::test::run({"evaluate", at("run"), "--reference", at("run")}));
  expectRefused({at("nothing.ply"), "no such file"},
                softscope::test::run({"evaluate", at("run"), "--reference", at("nothing.ply")}));
  fs::remove(at("run/trajectory.txt"));
  expectRefused({"trajectory.txt", "missing", "reconstruct"}, evaluate());
}

TEST_F(Evaluate, TablesThatDisagreeAreRefused) {
  write("run/frames.csv", "frame,status\n0,fused\n1,fused\n");
  expectRefused({"frames.csv", "2 frames", "6 poses"}, evaluate());
  write("run/frames.csv", "frame,status\n0,a\n1,a\n1,a\n2,a\n3,a\n4,a\n");
  expectRefused({"frames.csv", "must rise"}, evaluate());
  write("run/frames.csv", "frame,status\n0,a\n1\n");
  expectRefused({"frames.csv", "line 3", "1 cells"}, evaluate());
  write("run/frames.csv", "number,status\n0,a\n");
  expectRefused({"frames.csv", "no column `frame`"}, evaluate());
}

TEST_F(Evaluate, ARunOfAnotherSequenceIsRefused) {
  write("run/run.json", R"({"rectified_rig": {"width_px": 640, "height_px": 480}})");
  expectRefused({"run.json", "640 x 480", "160 x 120", "another sequence"}, evaluate());
  write("run/run.json", "[1, 2");
  expectRefused({"run.json", "no JSON"}, evaluate());
  fs::remove(at("run/run.json"));
  fs::copy(at("run/models/000003.ply"), at("run/models/000017.ply"));
  expectRefused({"000017.ply", "frame 17", "frames 0 to 5", "another sequence"}, evaluate());
  fs::remove(at("run/models/000017.ply"));
  fs::remove_all(at("truth"));
  makeWallTruth(at("truth"), kFrames - 1, false);
  expectRefused({"trajectory.txt", "frame 5", "frames 0 to 4"}, evaluate());
}

TEST_F(Evaluate, AnotherFocalLengthAndAForeignPlaceAreWarnedOf) {
  write("run/run.json",
        R"({"rectified_rig": {"width_px": 160, "height_px": 120, "focal_px": 200}})");
  EXPECT_THAT(evaluated()["warnings"].dump(), HasSubstr("focal length of 200"));
  PointCloud far = wallModel(0);
  for (auto& p : far.points_mm) p.z() += 40;
  writePly(at("run/models/000000.ply"), far, {"world", ""}, true);
  EXPECT_THAT(evaluated()["warnings"].dump(), HasSubstr("another sequence, or in another unit"));
}

TEST_F(Evaluate, NumbersThatAreNoneAreRefused) {
  PointCloud model = wallModel(2);
  model.points_mm[7].y() = std::nanf("");
  writePly(at("run/models/000002.ply"), model, {"world", ""}, true);
  expectRefused({"000002.ply", "point 7", "nan"}, evaluate());
  writePly(at("run/models/000002.ply"), wallModel(2), {"world", ""}, true);
  const std::string tracks = textOf(at("run/tracks.csv"));
  write("run/tracks.csv", tracks + "5,1.5,0,0,0,1\n");
  expectRefused({"tracks.csv", "1.5", "whole number"}, evaluate());
  write("run/tracks.csv", tracks + "5,one,0,0,0,1\n");
  expectRefused({"tracks.csv", "`one`"}, evaluate());
  write("run/tracks.csv", "frame,id,x_mm,y_mm,z_mm,visible\n0,99,0,0,0,1\n");
  expectRefused({"tracks.csv", "in common"}, evaluate());
  write("run/tracks.csv", tracks + "5,1,nan,nan,nan,0\n");
  EXPECT_EQ(evaluated()["tracks"]["lost"], 1) << "a lost point is no error";
  write("run/trajectory.txt", "0 0 0 0 0 0 0 nan\n");
  expectRefused({"trajectory.txt", "line 1"}, evaluate());
}

TEST_F(Evaluate, DamagedModelsAndTruthsAreRefused) {
  const std::string model = at("run/models/000003.ply");
  const std::string bytes = textOf(model);
  fs::resize_file(model, bytes.size() / 2);
  expectRefused({"000003.ply", "truncated"}, evaluate());
  write("run/models/000003.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n0 0 0\n");
  expectRefused({"000003.ply", "binary"}, evaluate());
  write("run/models/000003.ply", bytes);
  writeFile(at("truth/groundtruth/mesh/000003.ply"), "solid nothing", true);
  expectRefused({"groundtruth/mesh/000003.ply"}, evaluate());
}

TEST_F(Evaluate, ADepthOfAnotherSizeIsRefused) {
  writeDepthPng(at("truth/groundtruth/depth/000000.png"), Raster<float>(32, 24, 50.0f), 0.01, true);
  expectRefused({"depth/000000.png", "32 x 24", "160 x 120"}, evaluate());
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

TEST_F(Evaluate, OptionsThatMakeNoSenseAreUsageErrors) {
  EXPECT_EQ(evaluate({"--align", "icp"}).exit_code, 2) << "a sequence needs no alignment";
  EXPECT_EQ(evaluate({"--each"}).exit_code, 2);
  const std::string mesh = at("truth/groundtruth/mesh/000000.ply");
  EXPECT_EQ(softscope::test::run({"evaluate", at("run"), "--reference", mesh, "--align", "best"})
                .exit_code,
            2);
  EXPECT_EQ(softscope::test::run({"evaluate", at("run")}).exit_code, 2);
  write("file", "x");
  EXPECT_EQ(evaluate({"--out", at("file")}).exit_code, 2);
}

}  // namespace
}  // namespace softscope::test
