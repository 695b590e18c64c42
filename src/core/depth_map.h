// src/core/depth_map.h: depth per pixel of the rectified left camera.
#pragma once

#include <Eigen/Core>

#include "core/raster.h"

namespace softscope {

/// How far left each pixel of the rectified left image moved in the right one.
/// NaN where nothing was matched. Both rasters have the image's shape.
struct DisparityMap {
  Raster<float> disparity_px;
  Raster<float> sigma_px;  // predicted standard error of disparity_px; NaN where unmatched
};

/// Distance along the optical axis of the rectified left camera.
/// NaN where nothing was measured. Both rasters have the image's shape.
struct DepthMap {
  Raster<float> depth_mm;
  Raster<float> sigma_mm;  // predicted standard error of depth_mm; NaN where unmeasured
};

/// Unit normals of the measured surface, towards the camera, in the left camera's frame;
/// NaN where there is none.
using NormalMap = Raster<Eigen::Vector3f>;

}  // namespace softscope
