// vtk_views/files/point_cloud_vtp.h: a point cloud as ParaView reads it.
#pragma once

#include <string>

#include "core/point_cloud.h"

namespace softscope {

/// A VTP file (appended, compressed): points in mm, one vertex each, with the arrays Normals,
/// RGB and weight where the cloud has them. Throws Error where VTK can't write it.
std::string pointCloudVtp(const PointCloud& cloud);

}  // namespace softscope
