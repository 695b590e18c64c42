// vtk_views/volumes/volume_summary.h: header facts of a CT or MR volume.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace softscope {

struct VolumeSummary {
  std::string format;  // "NIfTI", "NRRD", "MetaImage", "DICOM"
  std::array<int, 3> size_voxels{};
  std::array<double, 3> spacing_mm{};  // between voxel centres, from positions if available
  /// p_lps = lps_from_voxel * (i, j, k, 1), mm; LPS: x to the patient's left, y back, z to the
  /// head.
  Eigen::Matrix4d lps_from_voxel = Eigen::Matrix4d::Identity();
  std::string file_space;  // convention of the header: "LPS", "RAS" …; "unknown" if absent
  std::string axes;        // directions of i, j, k, e.g. "LPS"; "unknown" in an unknown space
  std::string scalar_type;
  int components = 1;
  std::array<double, 2> value_range{};                       // of the first component
  std::vector<std::pair<std::string, std::string>> details;  // modality, scanner …; no patient data
  std::vector<std::pair<std::string, std::string>> patient;  // DICOM, on request only
  std::vector<std::string> warnings;                         // one line each
};

/// True if name or first bytes indicate a format of summariseVolume():
/// NIfTI, NRRD, MetaImage or DICOM file, or a folder with DICOM files.
bool looksLikeVolume(const std::string& path);

/// Properties of a volume given by the user.
struct VolumeOptions {
  /// Distance of voxel centres along i, j, k; replaces that of the file.
  std::optional<Eigen::Vector3d> spacing_mm;
  /// DICOM: missing or damaged slices become voxels without a
  /// value (NaN), with a warning; otherwise they are an error.
  bool allow_missing_slices = false;
  bool with_patient = false;  // DICOM: name, ID, sex, birth date, study date and series description
};

/// Reads the whole volume. From a folder with several DICOM series, the one with
/// most slices; the warnings name the others. Throws InputError for an unreadable
/// file, a missing or implausible geometry, or a value that is not finite.
VolumeSummary summariseVolume(const std::string& path, const VolumeOptions& options = {});

}  // namespace softscope
