// vtk_views/volumes/volume_files.h: a volume of any format, values and place.
#pragma once

#include <string>

#include "vtk_views/volumes/volume.h"

namespace softscope {

/// summariseVolume() with the voxels; of several values per voxel the first one.
Volume loadVolume(const std::string& path, const VolumeOptions& options);

}  // namespace softscope
