#include "stereo/refinement/pyramid.h"

#include <cmath>

#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope {

void fillFromHalf(const DisparityMap& half, DisparityMap& fine) {
  const Raster<float>& coarse = half.disparity_px;
  const auto fourAt = [](const Raster<float>& values, const HalfPosition& at) {
    return fourPixels(values.values.data(), values.width_px, values.height_px, at.u0, at.v0);
  };
  parallelRows(fine.disparity_px.height_px, [&](int v) {
    for (int u = 0; u < fine.disparity_px.width_px; ++u) {
      if (!std::isnan(fine.disparity_px.at(u, v))) continue;
      const HalfPosition at = halfPosition(u, v);
      if (!coarse.contains(at.u0, at.v0)) continue;
      const FourPixels disparity = fourAt(coarse, at);
      if (!isOneSurface(disparity)) continue;
      fine.disparity_px.at(u, v) = 2 * bilinear(disparity, at.fu, at.fv);
      fine.sigma_px.at(u, v) = 2 * bilinear(fourAt(half.sigma_px, at), at.fu, at.fv);
    }
  });
}

}  // namespace softscope
