// src/core/model_surface.h: model as a surface, for export to other programs.
#pragma once

#include <string>
#include <vector>

#include "core/length_unit.h"
#include "core/point_cloud.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// Points with triangles; without triangles a point cloud.
struct ModelSurface {
  PointCloud vertices;
  std::vector<Triangle> triangles;
  std::string space;  // "LPS", "RAS", or empty if unknown
  std::string frame;  // camera frame "world", "left" …; else empty
};

}  // namespace softscope
