#include "io/sequences/shipped_folders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/calibrations/calibration_reader.h"
#include "io/calibrations/shipped_calibrations.h"
#include "io/datasets/c3vd_files.h"
#include "io/datasets/stereomis_files.h"
#include "io/documents/npy_file.h"
#include "io/geometry/depth_files.h"
#include "io/temporary_folder.h"

namespace softscope::test {
namespace {

namespace fs = std::filesystem;

StereoCalibration shippedScope() {
  StereoCalibration scope;
  scope.left.pinhole = {640, 480, 567.5, 569, 318, 241};
  scope.right.pinhole = {640, 480, 567.5, 569, 340, 241};
  scope.right_from_left.translation().x() = -4.14;
  scope.rectified = true;
  return scope;
}

void touch(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(ShippedCalibrations, ComeBackInEveryForm) {
  const auto same = [](const StereoCalibration& read, const char* form) {
    EXPECT_EQ(read.form, form);
    EXPECT_EQ(read.left.pinhole.fx_px, 567.5) << form;
    EXPECT_EQ(read.left.pinhole.fy_px, 569) << form;
    EXPECT_EQ(read.right.pinhole.cx_px, 340) << form;
    EXPECT_NEAR(read.right_from_left.translation().x(), -4.14, 1e-12) << form;
    EXPECT_TRUE(read.right_from_left.linear().isIdentity(1e-12)) << form;
  };
  same(parseCalibration(projectionJson(shippedScope()), "001.json"), "SERV-CT");
  EXPECT_TRUE(parseCalibration(projectionJson(shippedScope()), "001.json").rectified);
  same(parseCalibration(firstStirCalibrationJson(shippedScope()), "calib.json"), "STIR");
  StereoCalibration bent = shippedScope();
  bent.left.distortion.coefficients[0] = -0.25;
  const auto read = parseCalibration(calibrationIni(bent), "StereoCalibration.ini");
  same(read, "StereoMIS");
  EXPECT_EQ(read.left.distortion.coefficients[0], -0.25);
  EXPECT_EQ(read.left.pinhole.width_px, 640);
  bent.left.distortion.coefficients[5] = 0.1;
  EXPECT_THROW(calibrationIni(bent), OptionError);

  TemporaryFolder folder;
  put(folder / "left_rect.yaml", cameraInfoYaml(shippedScope(), false));
  put(folder / "right_rect.yaml", cameraInfoYaml(shippedScope(), true));
  CalibrationHints hints;
  hints.rectified = true;
  same(readCalibration(folder / "left_rect.yaml", hints), "ROS");
}

TEST(ShippedCalibrations, BrokenOnesAreNamed) {
  const auto refuses = [](std::string text, const std::string& from, const std::string& to,
                          const std::string& name, const std::vector<std::string>& parts) {
    expectError<InputError>(
        [&] { parseCalibration(text.replace(text.find(from), from.size(), to), name); }, parts);
  };
  const std::string json = projectionJson(shippedScope());
  refuses(json, "567.5", "null", "1.json", {"1.json", "P1"});
  refuses(json, "\"cols\": 4", "\"cols\": 3", "1.json", {"1.json", "P1"});
  const std::string ini = calibrationIni(shippedScope());
  refuses(ini, "T_0=", "T_9=", "a.ini", {"a.ini", "stereoright.t_0"});
  refuses(ini, "fc_x=567.5", "fc_x=", "a.ini", {"a.ini", "stereoleft.fc_x"});
  refuses(ini, "res_x=640", "res_x 640", "a.ini", {"a.ini", "line"});
}

TEST(ShippedFolders, D4dImagesArePairedByTheTimeInTheirNames) {
  const auto pairs = pairByStamp({"1_000000000.png", "1_040000000.png", "1_080000000.png"},
                                 {"1_001000000.png", "1_079000000.png", "1_120000000.png"});
  ASSERT_EQ(pairs.left.size(), 2u);
  EXPECT_EQ(pairs.left[1], "1_080000000.png");
  EXPECT_EQ(pairs.right[1], "1_079000000.png");
  EXPECT_NEAR(pairs.times_s[1], 0.08, 1e-6);
  expectError<InputError>([] { pairByStamp({"a.png"}, {"1_0.png"}); },
                          {"a.png", "SECONDS_NANOSECONDS"});
  expectError<InputError>([] { pairByStamp({"1_0.png"}, {"2_0.png"}); },
                          {"1 left", "no two are of one moment"});
}

TEST(ShippedFolders, EachIsRecognisedByItsNames) {
  TemporaryFolder folder;
  touch(folder / "mis/video.mp4");
  touch(folder / "mis/StereoCalibration.ini");
  touch(folder / "mis/groundtruth.txt");
  auto clip = recogniseDataset(folder / "mis");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->form, "StereoMIS");
  EXPECT_EQ(clip->paths.layout, "top-bottom");
  EXPECT_EQ(clip->truth.size(), 1u);
  touch(folder / "mis/second.mp4");
  expectError<InputError>([&] { recogniseDataset(folder / "mis"); }, {"2 videos", "one is"});

  for (const char* side : {"left", "right"})
    touch(folder / "stir/p1" / side / "seq01/frames/0ms-900ms.mp4");
  touch(folder / "stir/p1/left/seq01/segmentation/icgstartseg.png");
  touch(folder / "stir/p1/calib.json");
  clip = recogniseDataset(folder / "stir/p1/left/seq01");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->form, "STIR");
  EXPECT_EQ(clip->paths.right.parent_path(),
            fs::absolute(folder / "stir/p1/right/seq01/frames").lexically_normal());
  fs::remove_all(folder / "stir/p1/right");
  expectError<InputError>([&] { recogniseDataset(folder / "stir/p1/left/seq01"); },
                          {"right/seq01", "is missing"});

  touch(folder / "colon/0000_color.png");
  touch(folder / "colon/0000_depth.tiff");
  touch(folder / "colon/pose.txt");
  clip = recogniseDataset(folder / "colon");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->form, "C3VD");
  EXPECT_EQ(clip->benchmark, "c3vd");
  EXPECT_EQ(clip->paths.depth_files.size(), 1u);
  touch(folder / "colon/0001_color.png");
  expectError<InputError>([&] { recogniseDataset(folder / "colon"); },
                          {"0001_depth.tiff", "is missing"});

  touch(folder / "rectified01/image01/0000000000.jpg");
  touch(folder / "rectified01/image02/0000000000.jpg");
  clip = recogniseDataset(folder / "rectified01");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->form, "Hamlyn");
  EXPECT_TRUE(clip->paths.rectified);

  touch(folder / "d4d/clips/Clip_1/left_images_rect/1_0.png");
  touch(folder / "d4d/clips/Clip_1/right_images_rect/1_0.png");
  expectError<InputError>([&] { recogniseDataset(folder / "d4d/clips/Clip_1"); },
                          {"left_rect.yaml", "is missing"});
  touch(folder / "d4d/camera_info/left_rect.yaml");
  clip = recogniseDataset(folder / "d4d/clips/Clip_1");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->form, "D4D");
  EXPECT_EQ(clip->paths.right_files.size(), 1u);
  EXPECT_FALSE(recogniseDataset(folder / "stir"));
}

TEST(ShippedFolders, ServCtPairsWithDifferentCalibrationsAreNoSequence) {
  TemporaryFolder folder;
  touch(folder / "Left_rectified/001.png");
  touch(folder / "Right_rectified/001.png");
  StereoCalibration scope = shippedScope();
  put(folder / "Rectified_calibration/001.json", projectionJson(scope));
  put(folder / "Rectified_calibration/002.json", projectionJson(scope));
  ASSERT_TRUE(recogniseDataset(folder / "."));
  scope.left.pinhole.cx_px += 1;
  put(folder / "Rectified_calibration/002.json", projectionJson(scope));
  expectError<InputError>([&] { recogniseDataset(folder / "."); },
                          {"002.json", "differs from 001.json", "one by one"});
}

TEST(StereoMisFiles, PathAndSplitComeBackOrAreRefused) {
  const auto path = parseStereoMisPath("0 1 2 3 0 0 0 1\n7 1.25 2.5 3 0 0 0 1\n", "g");
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path.at(7).translation(), Eigen::Vector3d(1250, 2500, 3000)) << "metres on disk";
  const auto in_mm = parseStereoMisPath("0 1 2 3 0 0 0 1\n7 4 5 6 0 0 0 1\n", "g");
  EXPECT_EQ(in_mm.at(7).translation(), Eigen::Vector3d(4, 5, 6)) << "no scope moves by 5 m";
  expectError<InputError>([] { parseStereoMisPath("0.5 1 2 3 0 0 0 1\n", "g.txt"); },
                          {"g.txt", "number of a frame"});
  expectError<InputError>([] { parseStereoMisPath("1 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n", "g.txt"); },
                          {"g.txt"});
  const auto ranges = parseStereoMisSplit("start,end\n5,10\n20,30\n", "s");
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[1].begin, 20);
  EXPECT_EQ(ranges[1].end, 30);
  expectError<InputError>([] { parseStereoMisSplit("start,end\n", "s.csv"); }, {"no range"});
  expectError<InputError>([] { parseStereoMisSplit("10,5\n", "s.csv"); }, {"line 1", "no frame"});
  expectError<InputError>([] { parseStereoMisSplit("1,2,3\n", "s.csv"); }, {"line 1"});
}

TEST(C3vdFiles, PosesComeBackInEitherOrderOfTheMatrixOrAreRefused) {
  const std::string first = "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n";
  // x to y, y to z, then 1, 2, 3 mm; column by column and row by row.
  const std::string columns = "0,1,0,0,0,0,1,0,1,0,0,0,1,2,3,1\n";
  const std::string rows = "0 0 1 1 1 0 0 2 0 1 0 3 0 0 0 1\n";
  for (const std::string& text : {first + columns, "\n" + first + rows}) {
    const auto path = parseC3vdPath(text, "pose.txt");
    ASSERT_EQ(path.size(), 2u);
    EXPECT_TRUE(path[0].matrix().isIdentity());
    EXPECT_TRUE((path[1] * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3)));
    EXPECT_EQ(c3vdPathText(path), first + columns);
  }
  const auto refuses = [](const std::string& text, const std::vector<std::string>& parts) {
    expectError<InputError>([&] { parseC3vdPath(text, "pose.txt"); }, parts);
  };
  refuses("", {"pose.txt", "no pose"});
  refuses(first + "1,0,0,0\n", {"pose.txt: line 2", "4 words", "16 numbers"});
  refuses(first + "0,1,0,0,-1,0,0,0,0,0,1,0,1,2,x,1\n", {"line 2", "x"});
  refuses(first + "0,1,0,0,-1,0,0,0,0,0,1,0,1,2,nan,1\n", {"line 2", "nan"});
  refuses(columns + rows, {"line 2", "another order"});
  refuses("0,1,0,0,-1,0,0,0,0,0,1,0,1,2,3,2\n", {"line 1", "0 0 0 1"});
  refuses("0,2,0,0,-1,0,0,0,0,0,1,0,1,2,3,1\n", {"line 1", "no rotation"});
  refuses("-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n", {"line 1", "no rotation"});
}

TEST(DepthInMetres, NumpyArraysAreReadEverywhere) {
  TemporaryFolder folder;
  Raster<float> depth_mm(3, 2, std::nanf(""));
  depth_mm.at(1, 1) = 73.5F;
  depth_mm.at(2, 0) = 40;
  writeDepthNpy(folder / "d.npy", depth_mm);
  const Raster<float> read = readDepth(folder / "d.npy");
  ASSERT_EQ(read.width_px, 3);
  EXPECT_NEAR(read.at(1, 1), 73.5, 1e-5);
  EXPECT_NEAR(read.at(2, 0), 40, 1e-5);
  EXPECT_TRUE(std::isnan(read.at(0, 0)));
  const std::string bytes = npyBytes(depth_mm);
  expectError<InputError>([&] { parseDepth(bytes.substr(0, bytes.size() - 3), "d.npy"); },
                          {"d.npy", "promises"});
}

TEST(DepthFiles, SixteenBitTiffKeepsItsStep) {
  TemporaryFolder folder;
  Raster<float> depth_mm(2, 1, std::nanf(""));
  depth_mm.at(0, 0) = 50;
  writeDepthTiff(folder / "d.tiff", depth_mm, 100.0 / 65535);
  const Raster<float> read = readDepth(folder / "d.tiff", 100.0 / 65535);
  EXPECT_NEAR(read.at(0, 0), 50, 0.001);
  EXPECT_TRUE(std::isnan(read.at(1, 0)));
}

}  // namespace
}  // namespace softscope::test
