// vtk_views/volume_files.cpp: four formats, one answer.
#include "vtk_views/volume_files.h"

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageHeader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "vtk_views/dicom_series.h"
#include "vtk_views/image_facts.h"
#include "vtk_views/text_header.h"
#include "vtk_views/vtk_errors.h"

namespace softscope {
namespace {

bool endsWith(const std::string& path, const std::string& ending) {
  if (path.size() < ending.size()) return false;
  return std::equal(
      ending.begin(), ending.end(), path.end() - std::ptrdiff_t(ending.size()),
      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool isNifti(const std::string& path) {
  return endsWith(path, ".nii") || endsWith(path, ".nii.gz");
}
bool isNrrd(const std::string& path) { return endsWith(path, ".nrrd") || endsWith(path, ".nhdr"); }
bool isMetaImage(const std::string& path) {
  return endsWith(path, ".mha") || endsWith(path, ".mhd");
}

/// Millimetres in one unit of the header; files that name none are taken as mm, as NIfTI tools do.
double unitOf(vtkNIFTIImageHeader* header, std::vector<std::string>& warnings) {
  switch (header->GetXYZTUnits() & vtkNIFTIImageHeader::UnitsSpace) {
    case vtkNIFTIImageHeader::UnitsMeter:
      return 1000;
    case vtkNIFTIImageHeader::UnitsMicron:
      return 0.001;
    case vtkNIFTIImageHeader::UnitsMM:
      return 1;
    default:
      warnings.emplace_back("the header names no unit of length; taken as mm");
      return 1;
  }
}

/// RAS from VTK's unscaled voxels: the sform where the file has one, else the qform.
Eigen::Matrix4d rasFromNifti(vtkNIFTIImageReader* reader, VolumeSummary& summary) {
  vtkMatrix4x4* sform = reader->GetSFormMatrix();
  vtkMatrix4x4* qform = reader->GetQFormMatrix();
  if (!sform && !qform) {
    summary.warnings.emplace_back("the header has neither sform nor qform: left and right unknown");
    return Eigen::Matrix4d::Identity();
  }
  summary.file_space = "RAS";
  if (sform && qform && !toEigen(*sform).isApprox(toEigen(*qform), 1e-3))
    summary.warnings.emplace_back("sform and qform disagree; the sform was taken");
  return toEigen(sform ? *sform : *qform);
}

LoadedVolume loadNifti(const std::string& path) {
  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(path.c_str());
  updateOrThrow(*reader, path);
  LoadedVolume loaded;
  loaded.image = reader->GetOutput();
  loaded.slope = reader->GetRescaleSlope();
  loaded.intercept = reader->GetRescaleIntercept();
  VolumeSummary& summary = loaded.summary;
  summary = imageFacts(*reader->GetOutput(), "NIfTI", path);
  summary.file_space = "unknown";
  const double unit_mm = unitOf(reader->GetNIFTIHeader(), summary.warnings);
  Eigen::Matrix4d space_from_voxel = rasFromNifti(reader, summary);
  for (int axis = 0; axis < 3; ++axis)
    space_from_voxel.col(axis) *= summary.spacing_mm[std::size_t(axis)];
  space_from_voxel.topRows<3>() *= unit_mm;
  for (double& value : summary.value_range) value = value * loaded.slope + loaded.intercept;
  placeInSpace(space_from_voxel, summary);
  return loaded;
}

template <class Reader>
LoadedVolume loadWithHeader(const std::string& path, const std::string& format,
                            const HeaderGeometry& geometry) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  updateOrThrow(*reader, path);
  LoadedVolume loaded;
  loaded.image = reader->GetOutput();
  loaded.summary = imageFacts(*reader->GetOutput(), format, path);
  loaded.summary.file_space = geometry.space;
  placeInSpace(geometry.space_from_voxel, loaded.summary);
  return loaded;
}

void checkPlausible(VolumeSummary& summary) {
  const auto [least, most] =
      std::minmax_element(summary.spacing_mm.begin(), summary.spacing_mm.end());
  double longest_mm = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    longest_mm = std::max(longest_mm, summary.spacing_mm[axis] * summary.size_voxels[axis]);
  if (longest_mm < 5)
    summary.warnings.push_back("the longest side is " + std::to_string(longest_mm) +
                               " mm, too short for an organ. In metres?");
  if (longest_mm > 5000)
    summary.warnings.push_back("the longest side is " + std::to_string(longest_mm) +
                               " mm, too long for a patient. In micrometres?");
  if (*least > 0 && *most / *least > 10)
    summary.warnings.emplace_back("voxels are more than 10 times longer than wide");
  if (summary.value_range[0] == summary.value_range[1])
    summary.warnings.emplace_back("every voxel has the same value");
}

LoadedVolume loadAny(const std::string& path, bool with_patient) {
  if (isNifti(path)) return loadNifti(path);
  if (isNrrd(path)) return loadWithHeader<vtkNrrdReader>(path, "NRRD", readNrrdGeometry(path));
  if (isMetaImage(path))
    return loadWithHeader<vtkMetaImageReader>(path, "MetaImage", readMetaImageGeometry(path));
  if (looksLikeDicom(path)) return loadDicom(path, with_patient);
  throw InputError(path +
                   ": no volume that softscope reads. Accepted: NIfTI (.nii, .nii.gz), NRRD "
                   "(.nrrd, .nhdr), MetaImage (.mha, .mhd), a DICOM file or folder");
}

}  // namespace

bool looksLikeVolume(const std::string& path) {
  return isNifti(path) || isNrrd(path) || isMetaImage(path) || looksLikeDicom(path);
}

LoadedVolume loadVolume(const std::string& path, bool with_patient) {
  if (!std::filesystem::exists(path)) throw InputError(path + ": does not exist");
  LoadedVolume loaded = loadAny(path, with_patient);
  checkPlausible(loaded.summary);
  return loaded;
}

VolumeSummary summariseVolume(const std::string& path, bool with_patient) {
  return loadVolume(path, with_patient).summary;
}

}  // namespace softscope
