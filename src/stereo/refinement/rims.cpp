#include "stereo/refinement/rims.h"

#include <algorithm>
#include <vector>

#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"
#include "stereo/options/stereo_options.h"

namespace softscope {
namespace {

static_assert(kBehindRimPx == 2 * RefinementOptions::radius_px + 1, "a window's width");

struct Rim {
  int column;
  float disparity_px;
};

std::vector<Rim> rimsInRow(const Raster<float>& disparity_px, int v) {
  std::vector<Rim> rims;
  for (int u = 0; u < disparity_px.width_px; ++u) {
    const float rim = rimDisparity([&](int x, int y) {
      return disparity_px.contains(u + x, v + y) ? disparity_px.at(u + x, v + y)
                                                 : kNotMeasured<float>;
    });
    if (rim < kNoRim) rims.push_back({u, rim});
  }
  return rims;
}

}  // namespace

void doubtRims(DisparityMap* map) {
  const Raster<float>& disparity_px = map->disparity_px;
  const int width = disparity_px.width_px, height = disparity_px.height_px;
  std::vector<std::vector<Rim>> rims(static_cast<std::size_t>(height));
  parallelRows(height,
               [&](int v) { rims[static_cast<std::size_t>(v)] = rimsInRow(disparity_px, v); });
  parallelRows(height, [&](int v) {
    const float* d = disparity_px.row(v);
    float* sigma = map->sigma_px.row(v);
    const int end = std::min(v + kRimReachPx + 1, height);
    for (int y = std::max(v - kRimReachPx, 0); y < end; ++y)
      for (const Rim& rim : rims[static_cast<std::size_t>(y)])
        for (int u = std::max(rim.column - kRimReachPx, 0);
             u < std::min(rim.column + kRimReachPx + 1, width); ++u)
          if (isAtRim(d[u], rim.disparity_px)) sigma[u] = sigmaAtRim(sigma[u]);
  });
}

}  // namespace softscope
