// tests/toolkit/evaluation_bad_input_test.cpp: errors of broken and foreign input.
#include <cmath>

#include "io/files/atomic_file.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/ply_writer.h"
#include "tests/toolkit/evaluation_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(Evaluation, MissingPartsOfARunAreNamed) {
  const auto refused = [&](const std::string& run, const std::string& reference,
                           const std::vector<std::string>& parts) {
    EvaluateOptions of;
    of.run = run;
    of.reference = reference;
    expectError<InputError>([&] { evaluateRun(of); }, parts);
  };
  refused(at("nowhere"), at("truth"), {at("nowhere")});
  refused(at("run"), at("run"), {at("run")});
  fs::create_directories(at("half/groundtruth"));
  refused(at("run"), at("half"), {"groundtruth/trajectory.txt", "missing"});
  refused(at("run"), at("nothing.ply"), {at("nothing.ply"), "no such file"});
  fs::remove(at("run/trajectory.txt"));
  expectRefused({"trajectory.txt", "missing", "reconstruct"});
}

TEST_F(Evaluation, TablesThatDisagreeAreRefused) {
  write("run/frames.csv", "frame,status\n0,fused\n1,fused\n");
  expectRefused({"frames.csv", "2 frames", "6 poses"});
  write("run/frames.csv", "frame,status\n0,a\n1,a\n1,a\n2,a\n3,a\n4,a\n");
  expectRefused({"frames.csv", "must ascend"});
  write("run/frames.csv", "frame,status\n0,a\n1\n");
  expectRefused({"frames.csv", "line 3", "1 cells"});
  write("run/frames.csv", "number,status\n0,a\n");
  expectRefused({"frames.csv", "no column `frame`"});
}

TEST_F(Evaluation, ARunOfAnotherSequenceIsRefused) {
  write("run/run.json", R"({"rectified_rig": {"width_px": 640, "height_px": 480}})");
  expectRefused({"run.json", "640 x 480", "160 x 120", "another sequence"});
  write("run/run.json", "[1, 2");
  expectRefused({"run.json", "no JSON"});
  fs::remove(at("run/run.json"));
  fs::copy(at("run/models/000003.ply"), at("run/models/000017.ply"));
  expectRefused({"000017.ply", "frame 17", "frames 0 to 5", "another sequence"});
  fs::remove(at("run/models/000017.ply"));
  fs::remove_all(at("truth"));
  makeWallTruth(at("truth"), kFrames - 1, false);
  expectRefused({"trajectory.txt", "frame 5", "frames 0 to 4"});
}

TEST_F(Evaluation, AnotherFocalLengthAndAForeignPlaceAreWarnedOf) {
  write("run/run.json",
        R"({"rectified_rig": {"width_px": 160, "height_px": 120, "focal_px": 200}})");
  EXPECT_THAT(evaluated()["warnings"].dump(), HasSubstr("focal length of 200"));
  PointCloud far = wallModel(0);
  for (auto& p : far.points_mm) p.z() += 40;
  writePly(at("run/models/000000.ply"), far, {"world", ""}, true);
  EXPECT_THAT(evaluated()["warnings"].dump(), HasSubstr("another sequence, or in another unit"));
}

TEST_F(Evaluation, NumbersThatAreNoneAreRefused) {
  PointCloud model = wallModel(2);
  model.points_mm[7].y() = std::nanf("");
  writePly(at("run/models/000002.ply"), model, {"world", ""}, true);
  expectRefused({"000002.ply", "point 7", "nan"});
  writePly(at("run/models/000002.ply"), wallModel(2), {"world", ""}, true);
  const std::string tracks = textOf(at("run/tracks.csv"));
  write("run/tracks.csv", tracks + "5,1.5,0,0,0,1\n");
  expectRefused({"tracks.csv", "1.5", "whole number"});
  write("run/tracks.csv", tracks + "5,one,0,0,0,1\n");
  expectRefused({"tracks.csv", "`one`"});
  write("run/tracks.csv", "frame,id,x_mm,y_mm,z_mm,visible\n0,99,0,0,0,1\n");
  expectRefused({"tracks.csv", "in common"});
  write("run/tracks.csv", tracks + "5,1,0,1099511627776,0,1\n");
  expectRefused({"tracks.csv", "1.09951e+12 mm", "within 1 km"});
  write("run/tracks.csv", tracks + "5,1,nan,nan,nan,0\n");
  EXPECT_EQ(evaluated()["tracks"]["lost"], 1) << "a lost point is no error";
  write("run/trajectory.txt", "0 0 0 0 0 0 0 nan\n");
  expectRefused({"trajectory.txt", "line 1"});
}

TEST_F(Evaluation, DamagedModelsAndTruthsAreRefused) {
  const std::string model = at("run/models/000003.ply");
  const std::string bytes = textOf(model);
  fs::resize_file(model, bytes.size() / 2);
  expectRefused({"000003.ply", "truncated"});
  write("run/models/000003.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n0 0 0\n");
  expectRefused({"000003.ply", "binary"});
  write("run/models/000003.ply", bytes);
  writeFile(at("truth/groundtruth/mesh/000003.ply"), "solid nothing", true);
  expectRefused({"groundtruth/mesh/000003.ply"});
}

TEST_F(Evaluation, ADepthOfAnotherSizeIsRefused) {
  writeDepthPng(at("truth/groundtruth/depth/000000.png"), Raster<float>(32, 24, 50.0f), 0.01, true);
  expectRefused({"depth/000000.png", "32 x 24", "160 x 120"});
}

TEST_F(Evaluation, OptionsThatMakeNoSenseAreRefused) {
  const auto refused = [](const EvaluateOptions& wrong, const std::string& part) {
    expectError<OptionError>([&] { evaluateRun(wrong); }, {part});
  };
  EvaluateOptions wrong = options();
  wrong.alignment = MeshAlignment::kIcp;
  refused(wrong, "`align=`");  // a sequence needs no alignment
  wrong = options();
  wrong.each_model = true;
  refused(wrong, "`each_model=`");
  expectError<OptionError>([] { meshAlignmentNamed("best", "--align"); }, {"--align", "best"});
  write("file", "x");
  expectError<OptionError>([&] { EvaluateOutputs(at("file"), false); }, {"`out=`", "is a file"});
}

}  // namespace
}  // namespace softscope::test
