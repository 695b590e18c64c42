#include "stereo/depth_from_disparity.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr int kNormalReach = 3;      // pixels
constexpr float kDepthStep = 0.05f;  // share of the depth: beyond it another surface
constexpr int kFewestPixels = 12;    // of 49, for a plane

/// Sums of a plane fit w(x, y) = c0 + c1 x + c2 y around one pixel.
struct PlaneSums {
  int n = 0;
  float x = 0, y = 0, xx = 0, xy = 0, yy = 0, w = 0, xw = 0, yw = 0;

  void add(float dx, float dy, float value) {
    ++n;
    x += dx, y += dy, xx += dx * dx, xy += dx * dy, yy += dy * dy;
    w += value, xw += dx * value, yw += dy * value;
  }
};

Eigen::Vector3f normalAt(const Raster<float>& depth, const PinholeCamera& camera, int u, int v) {
  const Eigen::Vector3f none = Eigen::Vector3f::Constant(kNaN);
  const float here = depth.at(u, v);
  if (std::isnan(here)) return none;
  PlaneSums s;
  for (int y = std::max(0, v - kNormalReach); y <= std::min(depth.height_px - 1, v + kNormalReach);
       ++y)
    for (int x = std::max(0, u - kNormalReach); x <= std::min(depth.width_px - 1, u + kNormalReach);
         ++x) {
      const float z = depth.at(x, y);
      // Scaled by the centre's depth, so that sums are near one whatever the unit.
      if (std::abs(z - here) < kDepthStep * here)
        s.add(static_cast<float>(x - u), static_cast<float>(y - v), here / z);
    }
  if (s.n < kFewestPixels) return none;
  Eigen::Matrix3f a;
  a << static_cast<float>(s.n), s.x, s.y, s.x, s.xx, s.xy, s.y, s.xy, s.yy;
  if (!(a.determinant() > 1e-3f)) return none;
  const Eigen::Vector3f plane = a.inverse() * Eigen::Vector3f(s.w, s.xw, s.yw);
  // n . X = k with X = z ((u - cx) / fx, (v - cy) / fy, 1) gives 1/z linear in u and v.
  const float fx = static_cast<float>(camera.fx_px), fy = static_cast<float>(camera.fy_px);
  const float du = static_cast<float>(u - camera.cx_px), dv = static_cast<float>(v - camera.cy_px);
  const Eigen::Vector3f n(plane.y() * fx, plane.z() * fy,
                          plane.x() - plane.y() * du - plane.z() * dv);
  return -n.normalized();  // inverse depth is positive in front: -n faces the camera
}

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

NormalMap normalsFromDepth(const Raster<float>& depth_mm, const PinholeCamera& camera) {
  NormalMap normals(depth_mm.width_px, depth_mm.height_px, Eigen::Vector3f::Constant(kNaN));
  parallelRows(depth_mm.height_px, [&](int v) {
    for (int u = 0; u < depth_mm.width_px; ++u) normals.at(u, v) = normalAt(depth_mm, camera, u, v);
  });
  return normals;
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
