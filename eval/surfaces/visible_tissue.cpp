// eval/surfaces/visible_tissue.cpp: back-projected pixels, projected points.
#include "eval/surfaces/visible_tissue.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace softscope {
namespace {

bool isDepth(float depth_mm) { return std::isfinite(depth_mm) && depth_mm > 0; }

void requireCamerasSize(const Raster<float>& depth_mm, const PinholeCamera& left) {
  if (depth_mm.width_px == left.width_px && depth_mm.height_px == left.height_px) return;
  throw InputError("the true depth has " + std::to_string(depth_mm.width_px) + " x " +
                   std::to_string(depth_mm.height_px) + " pixels, but the left camera has " +
                   std::to_string(left.width_px) + " x " + std::to_string(left.height_px) +
                   "; give the depth of this camera");
}

}  // namespace

void TissueSampling::validate() const {
  require(step_px >= 1, "step_px", step_px, "must be 1 or more");
  require(margin_px >= 0, "margin_px", margin_px, "can't be negative");
}

TissueSamples sampleVisibleTissue(const Raster<float>& depth_mm, const RectifiedRig& rig,
                                  const TissueSampling& sampling) {
  sampling.validate();
  requireCamerasSize(depth_mm, rig.left);
  const int margin = sampling.margin_px;
  const auto inLeft = [&](int u, int v) {
    return u < depth_mm.width_px - margin && v >= margin && v < depth_mm.height_px - margin;
  };
  TissueSamples samples;
  for (int v = 0; v < depth_mm.height_px; v += sampling.step_px)
    for (int u = 0; u < depth_mm.width_px; u += sampling.step_px) {
      const float z_mm = depth_mm.at(u, v);
      if (!isDepth(z_mm)) continue;
      samples.points_left_mm.push_back(
          liftPixel<double>(rig.left, u, v, static_cast<double>(z_mm)).cast<float>());
      samples.in_both.push_back(inLeft(u, v) && u - rig.disparityPx(z_mm) >= margin);
    }
  return samples;
}

bool isSurfacePointVisible(const Raster<float>& depth_mm, const PinholeCamera& left,
                           const Eigen::Vector3d& point_left_mm, double slack_mm) {
  if (!(point_left_mm.z() > 0)) return false;
  const Eigen::Vector2d pixel = projectPoint(left, point_left_mm);
  if (!(pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < left.width_px - 0.5 &&
        pixel.y() < left.height_px - 0.5))
    return false;
  const int u = static_cast<int>(std::floor(pixel.x())),
            v = static_cast<int>(std::floor(pixel.y()));
  float farthest_mm = -1;
  for (int dv = 0; dv <= 1; ++dv)
    for (int du = 0; du <= 1; ++du)
      if (depth_mm.contains(u + du, v + dv) && isDepth(depth_mm.at(u + du, v + dv)))
        farthest_mm = std::max(farthest_mm, depth_mm.at(u + du, v + dv));
  return farthest_mm > 0 && point_left_mm.z() <= farthest_mm + slack_mm;
}

}  // namespace softscope
