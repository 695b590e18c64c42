// tests/vtk_views/test_dicom.cpp: slices find their order and place, whatever their names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
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
#include <iterator>
#include <random>

#include "core/error.h"
#include "tests/vtk_views/dicom_tags.h"
#include "vtk_views/volumes/dicom_series.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

  /// The series anew, one tag of all slices, or of one, replaced or (null) taken out; in file order
  /// slice k is "slice<k + 1>".
  void writeSeries(vtkDICOMTag tag, const char* value, int only_slice) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    writeSeries();
    for (int k = 0; k < 6; ++k)
      if (only_slice < 0 || k == only_slice)
        test::replaceDicomTag(folder / ("slice" + std::to_string(k + 1)), tag.GetGroup(),
                              tag.GetElement(), value);
  }

  /// What reading the folder complains of; fails where it doesn't.
  std::string errorOf(const VolumeOptions& options) const {
    try {
      readVolume(folder, options);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.what();
    }
    ADD_FAILURE() << "was read";
    return {};
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
      const VolumeSummary one = loadDicom(entry.path(), {}).summary;
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
  const VolumeSummary summary = loadDicom(folder, {}).summary;
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
  const VolumeSummary quiet = loadDicom(folder, {}).summary;
  EXPECT_TRUE(quiet.patient.empty());
  for (const auto& [name, value] : quiet.details)
    EXPECT_TRUE(value.find("Doe") == std::string::npos && value != "oblique")
        << name << ": the series description is free text and may name a person";
  VolumeOptions with_patient;
  with_patient.with_patient = true;
  const VolumeSummary asked = loadDicom(folder, with_patient).summary;
  ASSERT_FALSE(asked.patient.empty());
  EXPECT_EQ(asked.patient[0].second, "Doe^Jane");
  EXPECT_EQ(asked.patient.back(), (std::pair<std::string, std::string>("series", "oblique")));
}

TEST_F(DicomFolder, AMissingSliceIsAnErrorUnlessAllowedAndThenItsPlaceIsEmpty) {
  removeSlice(3);
  EXPECT_THAT(errorOf({}), HasSubstr("1 slices are missing"));
  VolumeOptions options;
  options.allow_missing_slices = true;
  const Volume volume = readVolume(folder, options);
  ASSERT_EQ(volume.facts.warnings.size(), 1u);
  EXPECT_THAT(volume.facts.warnings[0], HasSubstr("1 slices are missing"));
  EXPECT_EQ(volume.facts.size_voxels, (std::array<int, 3>{5, 4, 6}));
  EXPECT_NEAR(volume.facts.spacing_mm[2], 1.25, 1e-5);
  EXPECT_TRUE(std::isnan(volume.at({1, 1, 3}))) << "nothing is made up between its neighbours";
  EXPECT_EQ(volume.at({1, 1, 4}), 86) << "the slices behind it stay where they are";
}

TEST_F(DicomFolder, ATruncatedSliceIsAnInputError) {
  const auto first = fs::directory_iterator(folder)->path();
  fs::resize_file(first, fs::file_size(first) - 10);
  EXPECT_THROW(loadDicom(folder, {}), InputError);
}

/// Tags that a slice may not have, and what the message must name.
TEST_F(DicomFolder, ASliceThatEndsBeforeItsPixelsIsAnErrorUnlessSlicesMayMiss) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  fs::resize_file(files[2], fs::file_size(files[2]) - 3);
  EXPECT_THAT(errorOf({}),
              AllOf(HasSubstr(files[2].filename().string()), HasSubstr("ends before its pixels do"),
                    HasSubstr("`allow_missing_slices=`"), Not(HasSubstr("vtk"))));
  VolumeOptions options;
  options.allow_missing_slices = true;
  const Volume volume = readVolume(folder, options);
  int empty = 0;
  for (int slice = 0; slice < volume.facts.size_voxels[2]; ++slice)
    empty += std::isnan(volume.at({1, 1, double(slice)}));
  EXPECT_LE(empty, 1);  // none where it was the first or the last
  EXPECT_EQ(volume.facts.size_voxels[2] - empty, 5);
}

struct BadTag {
  const char* what;
  vtkDICOMTag tag;
  const char* value;  // null: the tag is taken out
  const char* name;
};

class DicomTags : public DicomFolder, public testing::WithParamInterface<BadTag> {};

TEST_P(DicomTags, AreAnErrorThatNamesTheTagAndNeverAGuess) {
  writeSeries(GetParam().tag, GetParam().value, /*only_slice=*/-1);
  const std::string error = errorOf({});
  EXPECT_THAT(error, HasSubstr(GetParam().name));
  EXPECT_THAT(error, HasSubstr("slice"));  // the file
}

TEST_P(DicomTags, OfOneSliceAreAnErrorUnlessSlicesMayMiss) {
  writeSeries(GetParam().tag, GetParam().value, /*only_slice=*/2);
  EXPECT_THAT(errorOf({}), AllOf(HasSubstr("1 of 6 slices"), HasSubstr("`allow_missing_slices=`")));
  VolumeOptions options;
  options.allow_missing_slices = true;
  const Volume volume = readVolume(folder, options);
  EXPECT_EQ(volume.facts.size_voxels, (std::array<int, 3>{5, 4, 6}));
  EXPECT_TRUE(std::isnan(volume.at({1, 1, 2})));
  EXPECT_EQ(volume.at({1, 1, 3}), 66);
}

INSTANTIATE_TEST_SUITE_P(
    , DicomTags,
    testing::Values(
        BadTag{"NoSpacing", DC::PixelSpacing, nullptr, "PixelSpacing (0028,0030)"},
        BadTag{"ZeroSpacing", DC::PixelSpacing, "0\\0", "PixelSpacing (0028,0030)"},
        BadTag{"NegativeSpacing", DC::PixelSpacing, "0.6\\-0.5", "PixelSpacing"},
        BadTag{"TextSpacing", DC::PixelSpacing, "wide\\0.5", "is \"wide"},
        BadTag{"NanSpacing", DC::PixelSpacing, "nan\\0.5", "PixelSpacing"},
        BadTag{"OneSpacing", DC::PixelSpacing, "0.6", "two lengths above 0"},
        BadTag{"NoOrientation", DC::ImageOrientationPatient, nullptr,
               "ImageOrientationPatient (0020,0037)"},
        BadTag{"ZeroOrientation", DC::ImageOrientationPatient, "0\\0\\0\\0\\0\\0",
               "ImageOrientationPatient"},
        BadTag{"SkewOrientation", DC::ImageOrientationPatient, "1\\0\\0\\0.8\\0.6\\0",
               "at a right angle"},
        BadTag{"TextOrientation", DC::ImageOrientationPatient, "a\\b\\c\\d\\e\\f",
               "ImageOrientationPatient"},
        BadTag{"NoPosition", DC::ImagePositionPatient, nullptr, "ImagePositionPatient (0020,0032)"},
        BadTag{"TextPosition", DC::ImagePositionPatient, "here\\0\\0", "ImagePositionPatient"},
        BadTag{"ZeroSlope", DC::RescaleSlope, "0", "RescaleSlope (0028,1053)"},
        BadTag{"TextIntercept", DC::RescaleIntercept, "-10x", "RescaleIntercept"}),
    [](const auto& bad) { return std::string(bad.param.what); });

TEST_F(DicomFolder, AStatedSpacingReplacesTheMissingOne) {
  writeSeries(DC::PixelSpacing, nullptr, -1);
  VolumeOptions options;
  options.spacing_mm = Eigen::Vector3d(0.5, 0.6, 1.25);
  const Volume volume = readVolume(folder, options);
  EXPECT_NEAR(volume.facts.spacing_mm[0], 0.5, 1e-9);
  EXPECT_NEAR(volume.facts.spacing_mm[1], 0.6, 1e-9);
}

TEST_F(DicomFolder, OneSliceOfAnotherKindDropsNoOther) {
  writeSeries(DC::ImageOrientationPatient, "1\\0\\0\\0\\1\\0", 2);
  EXPECT_THAT(errorOf({}), HasSubstr("differs in"));
  VolumeOptions options;
  options.allow_missing_slices = true;
  const Volume volume = readVolume(folder, options);
  EXPECT_EQ(volume.facts.size_voxels[2], 6);
  EXPECT_TRUE(std::isnan(volume.at({1, 1, 2})));
  for (const int k : {0, 1, 3, 4, 5}) EXPECT_EQ(volume.at({1, 1, double(k)}), 6 + 20 * k);
}

TEST_F(DicomFolder, SlicesInOnePlaceOrAtUnevenDistancesAreErrors) {
  writeSeries(DC::ImagePositionPatient, "10\\20\\30", -1);
  EXPECT_THAT(errorOf({}), HasSubstr("have the same ImagePositionPatient"));
  writeSeries(DC::ImagePositionPatient, "12\\20\\30", 1);
  EXPECT_THAT(errorOf({}), HasSubstr("ImagePositionPatient (0020,0032) puts it"));
}

TEST_F(DicomFolder, ADamagedSliceIsNotLeftOutInSilence) {
  writeSeries(DC::PatientName, "Doe^Jane", -1);
  std::fstream file(folder / "slice6", std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(132);
  file << std::string(64, '\xff');
  file.close();
  EXPECT_THAT(errorOf({}), HasSubstr("slice6"));
}

TEST_F(DicomFolder, AnyDamageToASliceIsAnErrorOrASoundGeometry) {
  const fs::path slice = folder / "im2";
  std::ifstream in(slice, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  std::mt19937 random(3);
  for (int round = 0; round < 150; ++round) {
    std::string bad = good;
    for (int k = 0; k < 1 + round % 3; ++k)
      bad[132 + random() % (good.size() - 132)] = char(random());
    if (round % 7 == 0) bad.resize(random() % bad.size());
    if (round % 7 == 1) bad.erase(132 + random() % 500, 1 + random() % 3);
    std::ofstream(slice, std::ios::binary) << bad;
    try {
      const VolumeSummary summary = loadDicom(folder, {}).summary;
      EXPECT_TRUE(summary.size_voxels[2] == 6 || !summary.warnings.empty())
          << "round " << round << ": a slice was left out in silence";
      EXPECT_NEAR(summary.spacing_mm[0], 0.5, 1e-9) << "round " << round;
      EXPECT_NEAR(summary.spacing_mm[2], 1.25, 0.03) << "round " << round;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
}

TEST_F(DicomFolder, FramesOfOneFileAreSlicesToo) {
  const fs::path file = folder / "enhanced.dcm";
  test::writeMultiFrame(file, {30, 31.25, 32.5, 33.75});
  const Volume up = readVolume(file);
  EXPECT_EQ(up.facts.size_voxels, (std::array<int, 3>{5, 4, 4}));
  EXPECT_NEAR(up.facts.spacing_mm[0], 0.5, 1e-9);
  EXPECT_NEAR(up.facts.spacing_mm[2], 1.25, 1e-9);
  EXPECT_EQ(up.at({1, 1, 2}), 40 + 6 - 1000);
  test::writeMultiFrame(file, {33.75, 32.5, 31.25, 30});
  EXPECT_EQ(readVolume(file).at({1, 1, 1}), 40 + 6 - 1000) << "the third frame is the second slice";
  test::writeMultiFrame(file, {30, 31.25, 33.75, 35, 36.25});
  EXPECT_THROW(readVolume(file), InputError) << "one frame is missing";
  VolumeOptions options;
  options.allow_missing_slices = true;
  const Volume gap = readVolume(file, options);
  EXPECT_EQ(gap.facts.size_voxels[2], 6);
  EXPECT_TRUE(std::isnan(gap.at({1, 1, 2})));
  EXPECT_EQ(gap.at({1, 1, 3}), 40 + 6 - 1000);
}

TEST_F(DicomFolder, AFileNamedLikeASliceIsNoneThatMayBeLeftOut) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  for (const fs::path& file : files) fs::rename(file, file.string() + ".dcm");
  std::ofstream(folder / "notes.txt") << "text";
  EXPECT_EQ(loadDicom(folder, {}).summary.size_voxels[2], 6);
  fs::resize_file(folder / "im2.dcm", 65);
  EXPECT_THAT(errorOf({}), AllOf(HasSubstr("im2.dcm"), HasSubstr("1 of 6 slices")));
}

TEST_F(DicomFolder, APipeAmongTheFilesIsNotOpened) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(loadDicom(folder, {}).summary.size_voxels[2], 6);
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
