#include "stereo/refinement/depth_steps.h"

#include <cmath>

#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope {
namespace {

/// Marks both ends of every step along one line.
void markLine(const float* d, std::uint8_t* mark, int count, int stride, int widest, float step,
              float slope) {
  int last = -1;
  for (int i = 0; i < count; ++i) {
    if (std::isnan(d[i * stride])) continue;
    const int apart = i - last;
    if (last >= 0 && apart <= widest &&
        isDepthStep(d[i * stride], d[last * stride], apart, step, slope))
      mark[i * stride] = mark[last * stride] = 1;
    last = i;
  }
}

}  // namespace

Raster<std::uint8_t> nearDepthSteps(const Raster<float>& disparity_px, int radius_px, float step_px,
                                    float slope) {
  const int width = disparity_px.width_px, height = disparity_px.height_px;
  const int widest = 2 * radius_px + 1;
  const float* d = disparity_px.values.data();
  Raster<std::uint8_t> mark(width, height, 0);
  parallelRows(height, [&](int v) {
    markLine(disparity_px.row(v), mark.row(v), width, 1, widest, step_px, slope);
  });
  parallelRanges(width, 64, [&](int begin, int end) {
    for (int u = begin; u < end; ++u)
      markLine(d + u, mark.values.data() + u, height, width, widest, step_px, slope);
  });
  return dilated(mark, radius_px);
}

}  // namespace softscope
