#include "stereo/refinement/fringes.h"

#include <cmath>
#include <cstdint>

#include "core/mask_morphology.h"
#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope {
namespace {

Raster<std::uint8_t> nearUnmeasured(const Raster<float>& disparity_px) {
  Raster<std::uint8_t> unmeasured(disparity_px.width_px, disparity_px.height_px, 0);
  parallelRows(disparity_px.height_px, [&](int v) {
    const float* d = disparity_px.row(v);
    std::uint8_t* mark = unmeasured.row(v);
    for (int u = 0; u < disparity_px.width_px; ++u) mark[u] = std::isnan(d[u]);
  });
  return dilated(unmeasured, kFringeReachPx);
}

}  // namespace

void doubtFringes(const GrayImage& left, DisparityMap* map) {
  const Raster<float>& disparity_px = map->disparity_px;
  const Raster<std::uint8_t> near = nearUnmeasured(disparity_px);
  const auto pixelAt = [&](int u, int v) { return left.at(u, v); };
  parallelRows(left.height_px, [&](int v) {
    for (int u = 0; u < left.width_px; ++u) {
      if (near.at(u, v) == 0 || std::isnan(disparity_px.at(u, v))) continue;
      const auto disparityAt = [&](int x, int y) {
        return disparity_px.contains(u + x, v + y) ? disparity_px.at(u + x, v + y)
                                                   : kNotMeasured<float>;
      };
      const auto grayAt = [&](int x, int y) {
        return left.contains(u + x, v + y)
                   ? meanAround(u + x, v + y, left.width_px, left.height_px, pixelAt)
                   : kNotMeasured<float>;
      };
      float& sigma_px = map->sigma_px.at(u, v);
      if (isFringe(disparityAt, grayAt)) sigma_px = sigmaAtRim(sigma_px);
    }
  });
}

}  // namespace softscope
