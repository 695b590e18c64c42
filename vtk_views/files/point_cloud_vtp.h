// vtk_views/files/point_cloud_vtp.h: point cloud for ParaView.
#pragma once

#include <string>

#include "core/point_cloud.h"

namespace softscope {

/// VTP file (appended, compressed): points in mm, one vertex each, with the
/// arrays Normals, RGB and weight if present. Throws Error if VTK fails.
std::string pointCloudVtp(const PointCloud& cloud);

}  // namespace softscope
