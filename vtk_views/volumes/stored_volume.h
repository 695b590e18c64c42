// vtk_views/volumes/stored_volume.h: a volume as its file stores it, header and length checked.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "vtk_views/volumes/volume_summary.h"
#include "vtk_views/volumes/voxel_type.h"

namespace softscope {

/// Values are in this machine's byte order; i runs fastest.
struct StoredVolume {
  VolumeSummary summary;  // all but value_range
  VoxelType type = VoxelType::kInt16;
  bool planar = false;  // several values per voxel: all voxels of the first one, then of the next
  std::string bytes;
  double slope = 1, intercept = 0;  // value = slope * stored + intercept
  /// Per slice of the volume: the stored slice, -1 where it is missing. Empty: all, in order.
  std::vector<int> stored_slices;
};

/// `header`: from voxels to the file's own space in mm, its three columns finite and checked by
/// checkAxes(). Sets spacing, place and axes; a stated spacing replaces the lengths of the columns,
/// with a warning where `spacing_said` is true and they differ.
void placeVolume(Eigen::Matrix4d space_from_voxel, bool spacing_said, const VolumeOptions& options,
                 VolumeSummary& summary);

/// Throws InputError where a length is absurd (outside 0.1 um to 1 m), the origin lies beyond 100 m
/// or the axes come close to one plane. `what` names the header's lines.
void checkAxes(const std::string& path, const std::string& what,
               const Eigen::Matrix4d& space_from_voxel);

/// "give --spacing X,Y,Z in mm": the end of every message on a missing spacing.
extern const char* const kStateSpacing;

}  // namespace softscope
