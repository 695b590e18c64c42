// src/core/model_surface.h: a model as a surface, for export to other programs.
#pragma once

#include <string>
#include <vector>

#include "core/point_cloud.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// Points, and the triangles between them; points alone where there are none.
struct ModelSurface {
  PointCloud vertices;
  std::vector<Triangle> triangles;
  std::string space;  // "LPS", "RAS", or empty where nothing says it
  std::string frame;  // "world", "left" … where it lies in a scope's frame; else empty
};

/// In which a file's lengths are.
struct LengthUnit {
  std::string name = "mm";
  double mm = 1;  // how long it is
};

}  // namespace softscope
