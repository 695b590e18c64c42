// vtk_views/volumes/volume.h: the voxels of a CT or MR, where they lie in the patient.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

/// One value a voxel; of CT in Hounsfield units. i runs fastest, then j, then k; where they lie,
/// facts.lps_from_voxel says.
struct Volume {
  VolumeSummary facts;
  /// size_voxels[0] * size_voxels[1] * size_voxels[2]; finite, NaN in slices that are missing.
  std::vector<float> values;

  /// Linear between voxels; NaN beyond the centres of the outermost ones (by more than half a
  /// voxel). `voxel`: (i, j, k).
  float at(const Eigen::Vector3d& voxel) const;
  /// Of a point in LPS, mm.
  float atPoint(const Eigen::Vector3d& lps_mm) const;

  /// Whether values are Hounsfield units: DICOM says CT, or they reach from air to bone.
  bool inHounsfield() const;
  /// The value that `share` of the voxels lie below, from every n-th voxel.
  double percentile(double share) const;
};

/// DICOM file or folder, NIfTI, NRRD, MetaImage, as summariseVolume() finds them. Throws InputError
/// where the file can't be read or has several values a voxel.
Volume readVolume(const std::string& path, const VolumeOptions& options = {});

}  // namespace softscope
