// vtk_views/volumes/stored_volume.h: volume as stored in a file, with checked header and size.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vtk_views/volumes/volume_summary.h"
#include "vtk_views/volumes/voxel_type.h"

namespace softscope {

/// Values are in this machine's byte order; i runs fastest.
struct StoredVolume {
  VolumeSummary summary;  // without value_range
  VoxelType type = VoxelType::kInt16;
  bool planar = false;  // several values per voxel are stored one after the other
  std::string bytes;
  double slope = 1, intercept = 0;  // value = slope * stored + intercept
  /// Stored slice of each slice of the volume, -1 if missing. Empty: all, in order.
  std::vector<int> stored_slices;
};

/// `header`: from voxels to the space of the file in mm, with three finite columns checked
/// by checkAxes(). Sets spacing, place and axes; a spacing given by the user replaces the
/// lengths of the columns, with a warning if `spacing_said` is true and they differ.
void placeVolume(Eigen::Matrix4d space_from_voxel, bool spacing_said, const VolumeOptions& options,
                 VolumeSummary& summary);

/// Throws InputError for implausible lengths (outside of 0.1 um to 1 m), an
/// origin beyond 100 m, or nearly coplanar axes. `what`: lines of the header.
void checkAxes(const std::string& path, const std::string& what,
               const Eigen::Matrix4d& space_from_voxel);

/// "give --spacing X,Y,Z in mm": end of all messages about a missing spacing.
extern const char* const kStateSpacing;

}  // namespace softscope
