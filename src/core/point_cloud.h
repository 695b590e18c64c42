// src/core/point_cloud.h: measured points without structure.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.h"

namespace softscope {

/// N points, mm, in the frame that the owner names. What else is empty or N long.
struct PointCloud {
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Rgb8> colours;
  std::vector<float> weights;    // PointModel's
  std::vector<float> sigmas_mm;  // predicted standard errors; NaN where unknown
};

}  // namespace softscope
