// src/core/depth_map.h: depth per pixel of the rectified left camera.
#pragma once

#include <Eigen/Core>

#include "core/raster.h"

namespace softscope {

/// Displacement to the left of each pixel of the rectified left image in the
/// right one. NaN for unmatched pixels. Both rasters have the size of the image.
struct DisparityMap {
  Raster<float> disparity_px;
  Raster<float> sigma_px;  // predicted standard error of disparity_px; NaN for unmatched pixels
};

/// Distance along the optical axis of the rectified left camera. NaN
/// for unmeasured pixels. Both rasters have the size of the image.
struct DepthMap {
  Raster<float> depth_mm;
  Raster<float> sigma_mm;  // predicted standard error of depth_mm; NaN for unmeasured pixels
};

/// Unit normals of the measured surface, towards the
/// camera, in the left camera frame; NaN if undefined.
using NormalMap = Raster<Eigen::Vector3f>;

}  // namespace softscope
