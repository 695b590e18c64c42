#include "stereo/refinement/uneven_windows.h"

#include <algorithm>
#include <vector>

#include "core/not_measured.h"
#include "core/parallel.h"
#include "stereo/kernels/filter_formulas.h"

namespace softscope {
namespace {

/// What isUneven() asks for, of a row of pixels.
struct RowCounts {
  std::vector<int> measured, apart;

  explicit RowCounts(int width)
      : measured(static_cast<std::size_t>(width), 0), apart(static_cast<std::size_t>(width), 0) {}

  /// Of the pixels (x, 0) beside those at `centres` in the row `others`.
  void add(const float* others, int x, const float* centres) {
    const int width = static_cast<int>(measured.size());
    for (int u = std::max(-x, 0); u < std::min(width - x, width); ++u) {
      measured[static_cast<std::size_t>(u)] += isNumber(others[u + x]);
      apart[static_cast<std::size_t>(u)] += isApart(others[u + x], centres[u]);
    }
  }
};

}  // namespace

void dropUnevenWindows(int radius_px, DisparityMap* map) {
  const Raster<float> found = map->disparity_px;
  parallelRows(found.height_px, [&](int v) {
    RowCounts counts(found.width_px);
    for (int y = -radius_px; y <= radius_px; y += kUnevenSpacingPx)
      for (int x = -radius_px; x <= radius_px && v + y >= 0 && v + y < found.height_px;
           x += kUnevenSpacingPx)
        counts.add(found.row(v + y), x, found.row(v));
    float *disparity = map->disparity_px.row(v), *sigma = map->sigma_px.row(v);
    for (std::size_t u = 0; u < counts.apart.size(); ++u)
      if (isUneven(counts.apart[u], counts.measured[u]))
        disparity[u] = sigma[u] = kNotMeasured<float>;
  });
}

}  // namespace softscope
