// vtk_views/dicom_series.cpp: vtk-dicom sorts and places the slices; we look at what it found.
#include "vtk_views/dicom_series.h"

#include <vtkDICOMDirectory.h>
#include <vtkDICOMMetaData.h>
#include <vtkDICOMReader.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "vtk_views/image_facts.h"
#include "vtk_views/vtk_errors.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;
constexpr int kDeepestFolder = 4;     // exports nest: patient, study, series
constexpr int kFilesToTry = 50;       // before a folder is said to hold no DICOM
constexpr double kTiltWarnDeg = 0.5;  // between the slices' normal and the way they are stacked

bool hasPreamble(const fs::path& path) {
  char head[132] = {};
  std::ifstream file(path, std::ios::binary);
  return file.read(head, sizeof head) && std::memcmp(head + 128, "DICM", 4) == 0;
}

std::string text(vtkDICOMMetaData* meta, vtkDICOMTag tag) {
  return meta->Has(tag) ? meta->Get(tag).AsUTF8String() : std::string();
}

void add(std::vector<std::pair<std::string, std::string>>& list, const char* name,
         const std::string& value) {
  if (!value.empty()) list.emplace_back(name, value);
}

/// Files of the series with most slices; the others are named in `warnings`.
vtkSmartPointer<vtkStringArray> largestSeries(const std::string& path,
                                              std::vector<std::string>& warnings) {
  vtkNew<vtkDICOMDirectory> directory;
  directory->SetDirectoryName(path.c_str());
  directory->SetScanDepth(kDeepestFolder);
  directory->IgnoreDicomdirOn();
  updateOrThrow(*directory, path);
  const int count = directory->GetNumberOfSeries();
  if (count == 0) throw InputError(path + ": no DICOM series with pictures in this folder");
  int largest = 0;
  const auto slices = [&](int i) {
    return directory->GetFileNamesForSeries(i)->GetNumberOfValues();
  };
  for (int i = 1; i < count; ++i)
    if (slices(i) > slices(largest)) largest = i;
  for (int i = 0; i < count; ++i)
    if (i != largest)
      warnings.push_back(
          "another series lies in this folder, of " + std::to_string(slices(i)) +
          " files: " + text(directory->GetMetaDataForSeries(i), DC::SeriesDescription));
  return directory->GetFileNamesForSeries(largest);
}

/// Where each slice lies along the stack's normal, mm, ascending; empty where files don't say.
std::vector<double> slicePositions(vtkDICOMReader& reader, const Eigen::Vector3d& normal) {
  vtkDICOMMetaData* meta = reader.GetMetaData();
  std::vector<double> positions_mm;
  vtkIntArray* files = reader.GetFileIndexArray();
  for (vtkIdType slice = 0; slice < files->GetNumberOfTuples(); ++slice) {
    const auto& value = meta->Get(int(files->GetComponent(slice, 0)), DC::ImagePositionPatient);
    if (value.GetNumberOfValues() < 3) return {};
    positions_mm.push_back(
        normal.dot(Eigen::Vector3d(value.GetDouble(0), value.GetDouble(1), value.GetDouble(2))));
  }
  std::sort(positions_mm.begin(), positions_mm.end());
  return positions_mm;
}

void checkGaps(const std::vector<double>& positions_mm, std::vector<std::string>& warnings) {
  if (positions_mm.size() < 3) return;
  std::vector<double> gaps_mm;
  for (std::size_t i = 1; i < positions_mm.size(); ++i)
    gaps_mm.push_back(positions_mm[i] - positions_mm[i - 1]);
  std::vector<double> sorted = gaps_mm;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2),
                   sorted.end());
  const double usual_mm = sorted[sorted.size() / 2];
  if (usual_mm <= 0) return;
  long missing = 0;
  for (const double gap_mm : gaps_mm) missing += std::max(0L, std::lround(gap_mm / usual_mm) - 1);
  if (missing > 0)
    warnings.push_back("about " + std::to_string(missing) + " slices are missing: most lie " +
                       std::to_string(usual_mm) + " mm apart, some several times that");
}

void checkTilt(const Eigen::Matrix3d& axes, std::vector<std::string>& warnings) {
  const Eigen::Vector3d normal = axes.col(0).cross(axes.col(1)).normalized();
  const double cosine = std::min(1.0, std::abs(normal.dot(axes.col(2).normalized())));
  const double tilt_deg = std::acos(cosine) * 180 / M_PI;
  if (tilt_deg > kTiltWarnDeg)
    warnings.push_back("the gantry was tilted by " + std::to_string(tilt_deg) +
                       " degrees: slices are sheared against their stack");
}

void describe(vtkDICOMMetaData* meta, VolumeSummary& summary) {
  add(summary.details, "modality", text(meta, DC::Modality));
  add(summary.details, "body_part", text(meta, DC::BodyPartExamined));
  add(summary.details, "series", text(meta, DC::SeriesDescription));
  add(summary.details, "slice_thickness_mm", text(meta, DC::SliceThickness));
  add(summary.details, "manufacturer", text(meta, DC::Manufacturer));
}

void describePatient(vtkDICOMMetaData* meta, VolumeSummary& summary) {
  add(summary.patient, "name", text(meta, DC::PatientName));
  add(summary.patient, "id", text(meta, DC::PatientID));
  add(summary.patient, "sex", text(meta, DC::PatientSex));
  add(summary.patient, "birth_date", text(meta, DC::PatientBirthDate));
  add(summary.patient, "study_date", text(meta, DC::StudyDate));
}

}  // namespace

bool looksLikeDicom(const std::string& path) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return hasPreamble(path);
  int tried = 0;
  fs::recursive_directory_iterator entry(path, ignored), end;
  for (; entry != end && tried < kFilesToTry; entry.increment(ignored)) {
    if (entry.depth() >= kDeepestFolder) entry.disable_recursion_pending();
    if (!entry->is_regular_file(ignored)) continue;
    if (hasPreamble(entry->path())) return true;
    ++tried;
  }
  return false;
}

LoadedVolume loadDicom(const std::string& path, bool with_patient) {
  std::vector<std::string> warnings;
  vtkNew<vtkDICOMReader> reader;
  reader->SetMemoryRowOrderToFileNative();  // voxel (0, 0, 0) is the first pixel in the file
  if (fs::is_directory(path))
    reader->SetFileNames(largestSeries(path, warnings));
  else
    reader->SetFileName(path.c_str());
  updateOrThrow(*reader, path);
  LoadedVolume loaded;
  loaded.image = reader->GetOutput();
  VolumeSummary& summary = loaded.summary;
  summary = imageFacts(*reader->GetOutput(), "DICOM", path);
  summary.warnings = std::move(warnings);
  summary.file_space = "LPS";
  Eigen::Matrix4d lps_from_voxel = toEigen(*reader->GetPatientMatrix());
  for (int axis = 0; axis < 3; ++axis)
    lps_from_voxel.col(axis) *= summary.spacing_mm[std::size_t(axis)];
  placeInSpace(lps_from_voxel, summary);
  const Eigen::Matrix3d axes = lps_from_voxel.topLeftCorner<3, 3>();
  checkGaps(slicePositions(*reader, axes.col(0).cross(axes.col(1)).normalized()), summary.warnings);
  checkTilt(axes, summary.warnings);
  describe(reader->GetMetaData(), summary);
  if (with_patient) describePatient(reader->GetMetaData(), summary);
  return loaded;
}

}  // namespace softscope
