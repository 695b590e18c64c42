#include "stereo/matching/host_prior.h"

#include <vector>

#include "core/parallel.h"
#include "stereo/kernels/matching_formulas.h"
#include "stereo/matching/plane_prior.h"
#include "stereo/matching/support_points.h"

namespace softscope {

HostPrior planePrior(const Raster<float>& confirmed, const StereoOptions& level, int width_px,
                     int height_px) {
  const std::vector<SupportPoint> points = pointsOf(confirmed, level.elas);
  HostPrior prior;
  prior.point_count = static_cast<int>(points.size());
  prior.support = Raster<float>(confirmed.width_px, confirmed.height_px, kNoSupport);
  const int step = level.elas.support_step_px;
  for (const SupportPoint& p : points)
    prior.support.at(p.u_px / step, p.v_px / step) = p.disparity_px;
  parallelInvoke(
      [&] { prior.left_px8 = interpolatePlanes(points, width_px, height_px); },
      [&] { prior.right_px8 = interpolatePlanes(supportFromRight(points), width_px, height_px); });
  return prior;
}

}  // namespace softscope
