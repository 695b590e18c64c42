#include "stereo/depth/depth_from_disparity.h"

#include <cmath>
#include <numeric>
#include <vector>

#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope {

DepthMap depthFromDisparity(const DisparityMap& disparity, const RectifiedRig& rig) {
  const int width = disparity.disparity_px.width_px, height = disparity.disparity_px.height_px;
  DepthMap depth{Raster<float>(width, height, kNotMeasured<float>),
                 Raster<float>(width, height, kNotMeasured<float>)};
  const double scale = rig.left.fx_px * rig.baseline_mm;
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) {
      const double d = disparity.disparity_px.at(u, v) + rig.disparity_offset_px;
      if (!(d > 0)) continue;
      const DepthPixel pixel = depthOfDisparity(d, disparity.sigma_px.at(u, v), scale);
      depth.depth_mm.at(u, v) = pixel.depth_mm;
      depth.sigma_mm.at(u, v) = pixel.sigma_mm;
    }
  });
  return depth;
}

PointCloud pointCloud(const Raster<float>& depth_mm, const NormalMap& normals,
                      const ColourImage& colour, const PinholeCamera& camera, const Mask& mask) {
  const int width = depth_mm.width_px, height = depth_mm.height_px;
  const auto isPoint = [&](int u, int v) {
    return !std::isnan(depth_mm.at(u, v)) && !std::isnan(normals.at(u, v).x()) &&
           (mask.empty() || mask.at(u, v) == 0);
  };
  std::vector<std::size_t> first(static_cast<std::size_t>(height) + 1, 0);  // point of each row
  parallelRows(height, [&](int v) {
    for (int u = 0; u < width; ++u) first[static_cast<std::size_t>(v) + 1] += isPoint(u, v);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  PointCloud cloud;
  cloud.points_mm.resize(first.back());
  cloud.normals.resize(first.back());
  cloud.colours.resize(first.back());
  parallelRows(height, [&](int v) {
    std::size_t i = first[static_cast<std::size_t>(v)];
    for (int u = 0; u < width; ++u) {
      if (!isPoint(u, v)) continue;
      cloud.points_mm[i] =
          liftPixel(camera, static_cast<float>(u), static_cast<float>(v), depth_mm.at(u, v));
      cloud.normals[i] = normals.at(u, v);
      cloud.colours[i] = colour.at(u, v);
      ++i;
    }
  });
  return cloud;
}

}  // namespace softscope
