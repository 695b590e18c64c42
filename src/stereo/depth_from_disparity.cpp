#include "stereo/depth_from_disparity.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace

DepthMap depthFromDisparity(const DisparityMap& disparity, const RectifiedRig& rig) {
  const int width = disparity.disparity_px.width_px, height = disparity.disparity_px.height_px;
  DepthMap depth{Raster<float>(width, height, kNaN), Raster<float>(width, height, kNaN)};
  const double scale = rig.left.fx_px * rig.baseline_mm;
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      const double d = disparity.disparity_px.at(u, v) + rig.disparity_offset_px;
      if (!(d > 0)) continue;
      const double z = scale / d;
      depth.depth_mm.at(u, v) = static_cast<float>(z);
      depth.sigma_mm.at(u, v) = static_cast<float>(z * z / scale * disparity.sigma_px.at(u, v));
    }
  });
  return depth;
}

PointCloud pointCloud(const Raster<float>& depth_mm, const NormalMap& normals,
                      const ColourImage& colour, const PinholeCamera& camera, const Mask& mask) {
  PointCloud cloud;
  for (int v = 0; v < depth_mm.height_px; ++v)
    for (int u = 0; u < depth_mm.width_px; ++u) {
      const float z = depth_mm.at(u, v);
      if (std::isnan(z) || normals.at(u, v).hasNaN()) continue;
      if (!mask.empty() && mask.at(u, v) != 0) continue;
      cloud.points_mm.push_back(liftPixel(camera, static_cast<float>(u), static_cast<float>(v), z));
      cloud.normals.push_back(normals.at(u, v));
      cloud.colours.push_back(colour.at(u, v));
    }
  return cloud;
}

}  // namespace softscope
