// tests/vtk_views/test_volume_summary.cpp: every format puts the voxels in the same place.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "vtk_views/volumes/volume_summary.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

class VolumeFiles : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder = fs::temp_directory_path() / ("softscope_volume_" + test);
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
  fs::path folder;
};

/// 12 x 2 x 1 voxels of 16 bits, values 0 to 23. (VTK takes a short first axis for colours.)
std::string voxels() {
  std::string bytes;
  for (int i = 0; i < 24; ++i) {
    bytes += char(i);
    bytes += '\0';
  }
  return bytes;
}

TEST_F(VolumeFiles, NrrdGivesItsOwnDirections) {
  const auto path = write("oblique.nrrd",
                          "NRRD0004\ntype: short\ndimension: 3\nspace: right-anterior-superior\n"
                          "sizes: 12 2 1\nspace directions: (0,2,0) (-0.5,0,0) (0,0,3)\n"
                          "kinds: domain domain domain\nendian: little\nencoding: raw\n"
                          "space origin: (10,20,30)\n\n" +
                              voxels());
  const VolumeSummary summary = summariseVolume(path);
  EXPECT_EQ(summary.format, "NRRD");
  EXPECT_EQ(summary.file_space, "RAS");
  EXPECT_EQ(summary.size_voxels, (std::array<int, 3>{12, 2, 1}));
  EXPECT_DOUBLE_EQ(summary.spacing_mm[1], 0.5);
  // RAS to LPS turns x and y: i runs to the front (anterior), j to the left, k to the head.
  EXPECT_EQ(summary.axes, "ALS");
  EXPECT_DOUBLE_EQ(summary.lps_from_voxel(0, 3), -10);
  EXPECT_DOUBLE_EQ(summary.lps_from_voxel(1, 3), -20);
  EXPECT_DOUBLE_EQ(summary.value_range[1], 23);
}

TEST_F(VolumeFiles, MetaImageGivesItsMatrix) {
  const auto path = write("turned.mha",
                          "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                          "BinaryDataByteOrderMSB = False\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\n"
                          "Offset = 1 2 3\nElementSpacing = 0.5 0.6 2\nDimSize = 12 2 1\n"
                          "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                              voxels());
  const VolumeSummary summary = summariseVolume(path);
  EXPECT_EQ(summary.axes, "PRS");  // i to the back, j to the right
  EXPECT_NEAR(summary.spacing_mm[1], 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(summary.lps_from_voxel(2, 3), 3);
}

TEST_F(VolumeFiles, NiftiIsTurnedFromRasToLps) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 3, 2);
  image->SetSpacing(0.7, 0.8, 2.5);
  image->AllocateScalars(VTK_SHORT, 1);
  for (int i = 0; i < 24; ++i) static_cast<short*>(image->GetScalarPointer())[i] = short(i - 4);
  vtkNew<vtkMatrix4x4> ras;
  ras->SetElement(0, 3, 11);
  ras->SetElement(1, 3, 22);
  ras->SetElement(2, 3, 33);
  vtkNew<vtkNIFTIImageWriter> writer;
  writer->SetInputData(image);
  writer->SetQFormMatrix(ras);
  writer->SetSFormMatrix(ras);
  const std::string path = folder / "small.nii.gz";
  writer->SetFileName(path.c_str());
  writer->Write();

  const VolumeSummary summary = summariseVolume(path);
  EXPECT_EQ(summary.file_space, "RAS");
  EXPECT_EQ(summary.axes, "RAS");
  EXPECT_NEAR(summary.spacing_mm[2], 2.5, 1e-6);  // the header keeps floats
  EXPECT_NEAR(summary.lps_from_voxel(0, 3), -11, 1e-5);
  EXPECT_NEAR(summary.lps_from_voxel(0, 0), -0.7, 1e-6);
  EXPECT_NEAR(summary.lps_from_voxel(2, 3), 33, 1e-5);
  EXPECT_DOUBLE_EQ(summary.value_range[0], -4);
}

TEST_F(VolumeFiles, BrokenFilesAreInputErrorsThatNameThem) {
  const auto broken = {write("a.nii.gz", "no gzip at all"), write("b.nrrd", "NRRD0004\ntype: sh"),
                       write("c.mha", "ObjectType = Image\nNDims = 3\n"), write("d.nii", ""),
                       write("e.nrrd",
                             "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 2 1\n"
                             "spacings: 1 x 1\nencoding: raw\n\n" +
                                 voxels())};
  for (const std::string& path : broken) try {
      summariseVolume(path);
      ADD_FAILURE() << path << " was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST_F(VolumeFiles, AVolumeInMetresIsSuspected) {
  const auto path = write("metres.mha",
                          "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                          "BinaryDataByteOrderMSB = False\nOffset = 0 0 0\n"
                          "TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                          "ElementSpacing = 0.0007 0.0007 0.002\nDimSize = 12 2 1\n"
                          "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                              voxels());
  const VolumeSummary summary = summariseVolume(path);
  ASSERT_FALSE(summary.warnings.empty());
  EXPECT_NE(summary.warnings[0].find("In metres?"), std::string::npos);
}

TEST(VolumeFormats, OneCtInFourFormatsLiesInOnePlace) {
  const char* data = std::getenv("SOFTSCOPE_TEST_DATA");
  if (!data) GTEST_SKIP() << "SOFTSCOPE_TEST_DATA names no folder";
  const fs::path ct = fs::path(data) / "ct";
  if (!fs::exists(ct / "chaos_dicom")) GTEST_SKIP() << ct << " holds no chaos_dicom";
  const VolumeSummary dicom = summariseVolume(ct / "chaos_dicom");
  EXPECT_EQ(dicom.size_voxels, (std::array<int, 3>{512, 512, 78}));
  EXPECT_EQ(dicom.axes, "LPS");
  EXPECT_NEAR(dicom.spacing_mm[2], 2.0, 1e-6) << "slice thickness, 3.2, is not the spacing";
  for (const char* name : {"chaos_set3_ct_256x256x78.mha", "chaos_set3_ct_256x256x78.nrrd",
                           "chaos_set3_ct_256x256x78.nii.gz"}) {
    const VolumeSummary half = summariseVolume(ct / name);
    EXPECT_EQ(half.size_voxels, (std::array<int, 3>{256, 256, 78})) << name;
    // Every second voxel of the series. VTK may order NIfTI's rows and slices otherwise, but the
    // same corner of the box must come out: within 1e-3 mm, what a float header keeps.
    EXPECT_TRUE(half.lps_from_voxel.col(3).isApprox(dicom.lps_from_voxel.col(3), 1e-5)) << name;
    EXPECT_TRUE((half.lps_from_voxel.col(0)).isApprox(2 * dicom.lps_from_voxel.col(0), 1e-5));
    EXPECT_TRUE((half.lps_from_voxel.col(1)).isApprox(2 * dicom.lps_from_voxel.col(1), 1e-5));
    EXPECT_TRUE((half.lps_from_voxel.col(2)).isApprox(dicom.lps_from_voxel.col(2), 1e-5)) << name;
  }
}

}  // namespace
}  // namespace softscope
