// tests/apps/test_evaluate_bad_input.cpp: what `softscope evaluate` says of broken and foreign
// input.
#include <cmath>

#include "io/files/atomic_file.h"
#include "io/geometry/depth_files.h"
#include "io/geometry/ply_writer.h"
#include "tests/apps/evaluate_fixture.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(Evaluate, MissingPartsOfARunAreNamed) {
  expectRefused({at("nowhere")},
                softscope::test::run({"evaluate", at("nowhere"), "--reference", at("truth")}));
  expectRefused({at("run")},
                softscope::test::run({"evaluate", at("run"), "--reference", at("run")}));
  fs::create_directories(at("half/groundtruth"));
  expectRefused({"groundtruth/trajectory.txt", "missing"},
                softscope::test::run({"evaluate", at("run"), "--reference", at("half")}));
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
  write("run/tracks.csv", tracks + "5,1,0,1099511627776,0,1\n");
  expectRefused({"tracks.csv", "1.09951e+12 mm", "within 1 km"}, evaluate());
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
