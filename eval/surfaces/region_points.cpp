// eval/surfaces/region_points.cpp: lift what is measured and judged.
#include "eval/surfaces/region_points.h"

#include <cmath>

#include "eval/images/pixel_masks.h"

namespace softscope {

std::vector<Eigen::Vector3f> pointsInRegion(const Raster<float>& depth_mm,
                                            const PinholeCamera& camera,
                                            const Raster<std::uint8_t>& region) {
  requireSameShape(depth_mm, region, "depth map");
  std::vector<Eigen::Vector3f> points_mm;
  for (int v = 0; v < region.height_px; ++v)
    for (int u = 0; u < region.width_px; ++u)
      if (region.at(u, v) && std::isfinite(depth_mm.at(u, v)))
        points_mm.push_back(liftPixel<double>(camera, u, v, depth_mm.at(u, v)).cast<float>());
  return points_mm;
}

}  // namespace softscope
