// vtk_views/volumes/volume.h: voxels of a CT or MR, with their geometry.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "vtk_views/volumes/volume_summary.h"

namespace softscope {

/// One value per voxel; for CT in Hounsfield units. i is the
/// fastest index, then j, then k; geometry: facts.lps_from_voxel.
struct Volume {
  VolumeSummary facts;
  /// size_voxels[0] * size_voxels[1] * size_voxels[2]; finite, NaN in missing slices.
  std::vector<float> values;

  /// Linear interpolation; NaN more than half a voxel
  /// outside of the outermost centres. `voxel`: (i, j, k).
  float at(const Eigen::Vector3d& voxel) const;
  /// At a point in LPS, mm.
  float atPoint(const Eigen::Vector3d& lps_mm) const;

  /// True for CT by DICOM, or for values from air to bone.
  bool inHounsfield() const;
  /// Quantile of the voxel values, from every n-th voxel.
  double percentile(double share) const;
};

/// DICOM file or folder, NIfTI, NRRD or MetaImage, as in summariseVolume().
/// Throws InputError for an unreadable file or several values per voxel.
Volume readVolume(const std::string& path, const VolumeOptions& options = {});

}  // namespace softscope
