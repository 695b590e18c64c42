// vtk_views/volumes/volume_files.h: reader of volumes of all formats, with their geometry.
#pragma once

#include <string>

#include "vtk_views/volumes/volume.h"

namespace softscope {

/// summariseVolume() with the voxels; the first of several values per voxel.
Volume loadVolume(const std::string& path, const VolumeOptions& options);

}  // namespace softscope
