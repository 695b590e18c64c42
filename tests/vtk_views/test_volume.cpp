// tests/vtk_views/test_volume.cpp: left stays left through every reader, values are the file's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "tests/support/data_folder.h"
#include "tests/vtk_views/marker_volumes.h"
#include "vtk_views/scenes/slice_picture.h"
#include "vtk_views/volumes/grey_window.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

class Volumes : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder = fs::temp_directory_path() / ("softscope_volumes_" + test);
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(Volumes, MarksLieWhereTheyDoInThePatientThroughEveryReader) {
  const auto files = test::writeMarkerVolumes(folder);
  ASSERT_EQ(files.size(), 12u);
  for (const test::MarkerFile& file : files) {
    SCOPED_TRACE(file.what);
    const Volume volume = readVolume(file.path);
    for (const test::Mark& mark : test::marks()) {
      EXPECT_NEAR(volume.atPoint(mark.lps_mm), mark.value, 1);  // inside a ball of one value
      for (int axis = 0; axis < 3; ++axis) {  // mirrored at the volume's middle: air, or outside
        Eigen::Vector3d mirrored = mark.lps_mm;
        mirrored[axis] = 2 * Eigen::Vector3d(30, -50, 700)[axis] - mirrored[axis];
        EXPECT_FALSE(volume.atPoint(mirrored) > -900) << "axis " << axis;
      }
    }
    EXPECT_TRUE(volume.inHounsfield());
  }
}

TEST_F(Volumes, TheAxialPictureHasTheMarksOnTheirSides) {
  for (const test::MarkerFile& file : test::writeMarkerVolumes(folder)) {
    SCOPED_TRACE(file.what);
    const Volume volume = readVolume(file.path);
    const test::Mark mark = test::marks()[0];  // 11 mm to the patient's left, 11 mm to the front
    const Eigen::Vector3d centre(30, -50, mark.lps_mm.z());
    const GreyWindow window{"", 3000, 500};
    const ColourImage picture =
        slicePicture(volume, axialView(centre, SceneFrame::kPatient, SideRule::kRadiological),
                     {44, 44}, window, 44, 44);  // a pixel is a millimetre
    EXPECT_GT(picture.at(22 + 11, 22 - 11).red, 100) << "patient's left is on the right, front up";
    EXPECT_LT(picture.at(22 - 11, 22 - 11).red, 30);
    EXPECT_LT(picture.at(22 + 11, 22 + 11).red, 30);
    const ColourImage neurological =
        slicePicture(volume, axialView(centre, SceneFrame::kPatient, SideRule::kNeurological),
                     {44, 44}, window, 44, 44);
    EXPECT_GT(neurological.at(22 - 11, 22 - 11).red, 100) << "left on the left";
  }
}

TEST_F(Volumes, ValuesBetweenVoxelsAreLinearAndBeyondThemUnknown) {
  Volume volume;
  volume.facts.size_voxels = {3, 2, 1};
  volume.values = {0, 10, 20, 100, 110, 120};
  EXPECT_FLOAT_EQ(volume.at({0.5, 0, 0}), 5);
  EXPECT_FLOAT_EQ(volume.at({1.25, 0.5, 0}), 62.5);
  EXPECT_FLOAT_EQ(volume.at({2, 1, 0}), 120);
  EXPECT_FLOAT_EQ(volume.at({2.4, 1, 0.4}), 120) << "half a voxel around is the voxel's";
  EXPECT_TRUE(std::isnan(volume.at({2.6, 1, 0})));
  EXPECT_TRUE(std::isnan(volume.at({1, 0, -0.6})));
  EXPECT_TRUE(std::isnan(volume.at({NAN, 0, 0})));
}

TEST_F(Volumes, WindowsSuitTheirValues) {
  Volume mr;
  mr.facts.size_voxels = {101, 1, 1};
  mr.facts.value_range = {0, 100};
  for (int i = 0; i <= 100; ++i) mr.values.push_back(float(i));
  const GreyWindow middle = parseWindow("auto", mr);
  EXPECT_NEAR(middle.level, 50, 1);
  EXPECT_NEAR(middle.width, 98, 2);
  EXPECT_THROW(parseWindow("bone", mr), OptionError) << "not in Hounsfield units";
  Volume ct = mr;
  ct.facts.details = {{"modality", "CT"}};
  EXPECT_EQ(parseWindow("auto", ct).name, "soft-tissue");
  EXPECT_EQ(parseWindow("lung", ct).level, -600);
  const GreyWindow own = parseWindow("200,-50", ct);
  EXPECT_EQ(own.grey(-150), 0);
  EXPECT_EQ(own.grey(-50), 128);
  EXPECT_EQ(own.grey(50), 255);
  EXPECT_EQ(own.grey(NAN), 0);
  for (const char* wrong : {"bones", "0,10", "10", "a,b", "10,10,10", "nan,0"})
    EXPECT_THROW(parseWindow(wrong, ct), OptionError) << wrong;
}

TEST_F(Volumes, FilesCutShortAreInputErrorsInOneLine) {
  for (const test::MarkerFile& file : test::writeMarkerVolumes(folder)) {
    const fs::path victim =
        fs::is_directory(file.path) ? fs::directory_iterator(file.path)->path() : file.path;
    fs::resize_file(victim, fs::file_size(victim) * 3 / 4);
    try {
      readVolume(file.path);
      ADD_FAILURE() << file.what << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(folder.string())) << file.what;
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n"))) << file.what;
    }
  }
}

TEST_F(Volumes, CompressedFilesCutShortAreInputErrorsToo) {
  SOFTSCOPE_DATA_OR_SKIP(ct, "ct");
  for (const char* name : {"chaos_set3_ct_256x256x78.mha", "chaos_set3_ct_256x256x78.nrrd",
                           "chaos_set3_ct_256x256x78.nii.gz"}) {
    fs::copy_file(ct / name, folder / name);
    fs::resize_file(folder / name, fs::file_size(folder / name) / 2);
    EXPECT_THROW(readVolume(folder / name), InputError) << name;
  }
}

TEST_F(Volumes, WhatIsNoVolumeIsAnInputError) {
  fs::create_directories(folder / "empty");
  std::ofstream(folder / "notes.txt") << "text";
  for (const char* name : {"missing.mha", "empty", "notes.txt"})
    EXPECT_THROW(readVolume(folder / name), InputError) << name;
  std::ofstream(folder / "flat.nrrd", std::ios::binary)
      << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 12 2 1\n"
         "space directions: (1,0,0) (1,0,0) (0,0,1)\nspace origin: (0,0,0)\nendian: little\n"
         "encoding: raw\n\n"
      << std::string(48, '\1');
  EXPECT_THROW(readVolume(folder / "flat.nrrd"), InputError) << "axes in one plane";
}

TEST(VolumeValues, OneCtInFourFormatsHasOneValueInOnePlace) {
  SOFTSCOPE_DATA_OR_SKIP(ct, "ct");
  const Volume dicom = readVolume(ct / "chaos_dicom");
  for (const char* name : {"chaos_set3_ct_256x256x78.mha", "chaos_set3_ct_256x256x78.nrrd",
                           "chaos_set3_ct_256x256x78.nii.gz"}) {
    const Volume half = readVolume(ct / name);
    for (const Eigen::Vector3d& voxel :
         {Eigen::Vector3d(100, 200, 30), {300, 250, 60}, {256, 400, 5}}) {
      const Eigen::Vector3d place =  // every second voxel of the series is the other's own
          (dicom.facts.lps_from_voxel * Eigen::Vector4d(voxel[0], voxel[1], voxel[2], 1)).head<3>();
      EXPECT_NEAR(half.atPoint(place), dicom.atPoint(place), 1.0) << name;  // HU are whole numbers
    }
  }
}

}  // namespace
}  // namespace softscope
