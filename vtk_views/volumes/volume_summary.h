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
  std::array<double, 3> spacing_mm{};  // between voxel centres, from positions where there are any
  /// p_lps = lps_from_voxel * (i, j, k, 1), mm; LPS: x to the patient's left, y back, z to the
  /// head.
  Eigen::Matrix4d lps_from_voxel = Eigen::Matrix4d::Identity();
  std::string file_space;  // the header's own convention: "LPS", "RAS" …; "unknown" if it says none
  std::string axes;        // where i, j, k run to, e.g. "LPS"; "unknown" in an unknown space
  std::string scalar_type;
  int components = 1;
  std::array<double, 2> value_range{};                       // of the first component
  std::vector<std::pair<std::string, std::string>> details;  // modality, scanner …; no patient
  std::vector<std::pair<std::string, std::string>> patient;  // DICOM, and only if asked for
  std::vector<std::string> warnings;                         // a line each
};

/// True where the name or the first bytes say that summariseVolume() may read it: NIfTI, NRRD,
/// MetaImage or DICOM file, or a folder that holds DICOM files.
bool looksLikeVolume(const std::string& path);

/// What the user states about a volume.
struct VolumeOptions {
  /// Distance of voxel centres along i, j, k; replaces what the file says, or fails to say.
  std::optional<Eigen::Vector3d> spacing_mm;
  /// DICOM: slices that are missing or damaged become voxels without a value (NaN), with a warning;
  /// otherwise they are an error.
  bool allow_missing_slices = false;
  bool with_patient = false;  // DICOM: name, ID, sex, birth date, study date and series description
};

/// Reads the whole volume. Of a folder with several DICOM series, the one with most slices; the
/// others are named in the warnings. Throws InputError where the file can't be read, where its
/// header leaves the geometry unsaid or says an absurd one, or a value is not finite.
VolumeSummary summariseVolume(const std::string& path, const VolumeOptions& options = {});

}  // namespace softscope
