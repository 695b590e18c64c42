// tests/vtk_views/test_dicom.cpp: slices find their order and place, whatever their names.
#include <gtest/gtest.h>
#include <vtkDICOMCTGenerator.h>
#include <vtkDICOMMetaData.h>
#include <vtkDICOMWriter.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "vtk_views/dicom_series.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

/// An oblique series of 6 slices, pixels 0.5 x 0.6 mm, 1.25 mm apart, its first voxel at
/// (10, 20, 30) mm; file names in an order that isn't theirs.
class DicomFolder : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder = fs::temp_directory_path() / ("softscope_dicom_" + test);
    fs::remove_all(folder);
    fs::create_directories(folder);
    writeSeries();
    shuffleNames();
  }
  void TearDown() override { fs::remove_all(folder); }

  void writeSeries() {
    vtkNew<vtkImageData> image;
    image->SetDimensions(5, 4, 6);
    image->SetSpacing(0.5, 0.6, 1.25);
    image->AllocateScalars(VTK_SHORT, 1);
    for (int i = 0; i < 120; ++i) static_cast<short*>(image->GetScalarPointer())[i] = short(i);
    vtkNew<vtkDICOMMetaData> meta;
    meta->Set(DC::PatientName, "Doe^Jane");
    meta->Set(DC::SeriesDescription, "oblique");
    vtkNew<vtkDICOMCTGenerator> generator;
    vtkNew<vtkDICOMWriter> writer;
    writer->SetInputData(image);
    writer->SetMetaData(meta);
    writer->SetGenerator(generator);
    writer->SetMemoryRowOrderToFileNative();
    writer->SetPatientMatrix(lpsFromScan());
    writer->SetFilePrefix(folder.c_str());
    writer->SetFilePattern("%s/slice%d");
    writer->Write();
  }

  static vtkSmartPointer<vtkMatrix4x4> lpsFromScan() {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) matrix->SetElement(row, column, turn(row, column));
      matrix->SetElement(row, 3, 10 * (row + 1));
    }
    return matrix;
  }

  void shuffleNames() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i < files.size(); ++i)
      fs::rename(files[i], folder / ("im" + std::to_string((i * 5 + 2) % 7)));
  }

  /// Of the slice at this place in the stack, by its position in the file.
  void removeSlice(int place) const {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const VolumeSummary one = loadDicom(entry.path(), false).summary;
      const Eigen::Vector3d offset =
          one.lps_from_voxel.topRightCorner<3, 1>() - Eigen::Vector3d(10, 20, 30);
      if (std::lround(offset.norm() / 1.25) == place) {
        fs::remove(entry.path());
        return;
      }
    }
    FAIL() << "no slice at place " << place;
  }

  fs::path folder;
};

TEST_F(DicomFolder, ShuffledObliqueSlicesAreSortedAndPlaced) {
  const VolumeSummary summary = loadDicom(folder, false).summary;
  EXPECT_EQ(summary.size_voxels, (std::array<int, 3>{5, 4, 6}));
  EXPECT_NEAR(summary.spacing_mm[0], 0.5, 1e-9) << "column and row spacing must not be swapped";
  EXPECT_NEAR(summary.spacing_mm[1], 0.6, 1e-9);
  EXPECT_NEAR(summary.spacing_mm[2], 1.25, 1e-6);
  EXPECT_NEAR(summary.lps_from_voxel(0, 3), 10, 1e-4);  // DICOM keeps decimal text
  EXPECT_NEAR(summary.lps_from_voxel(2, 3), 30, 1e-4);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_TRUE(summary.lps_from_voxel.col(2).head<3>().isApprox(1.25 * turn.col(2), 1e-5));
  EXPECT_TRUE(summary.warnings.empty()) << summary.warnings[0];
}

TEST_F(DicomFolder, PatientFieldsComeOnlyWhenAsked) {
  const VolumeSummary quiet = loadDicom(folder, false).summary;
  EXPECT_TRUE(quiet.patient.empty());
  for (const auto& [name, value] : quiet.details)
    EXPECT_EQ(value.find("Doe"), std::string::npos) << name;
  const VolumeSummary asked = loadDicom(folder, true).summary;
  ASSERT_FALSE(asked.patient.empty());
  EXPECT_EQ(asked.patient[0].second, "Doe^Jane");
}

TEST_F(DicomFolder, AMissingSliceIsNoticed) {
  removeSlice(3);
  const VolumeSummary summary = loadDicom(folder, false).summary;
  ASSERT_EQ(summary.warnings.size(), 1u);
  EXPECT_NE(summary.warnings[0].find("1 slices are missing"), std::string::npos)
      << summary.warnings[0];
}

TEST_F(DicomFolder, ATruncatedSliceIsAnInputError) {
  const auto first = fs::directory_iterator(folder)->path();
  fs::resize_file(first, fs::file_size(first) - 10);
  EXPECT_THROW(loadDicom(folder, false), InputError);
}

TEST_F(DicomFolder, IsRecognisedByItsFilesNotTheirNames) {
  EXPECT_TRUE(looksLikeDicom(folder));
  const fs::path empty = folder / "empty";
  fs::create_directories(empty);
  EXPECT_FALSE(looksLikeDicom(empty));
  std::ofstream(empty / "a.dcm") << "text";
  EXPECT_FALSE(looksLikeDicom(empty));
}

}  // namespace
}  // namespace softscope
