#include "stereo/spread.h"

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

/// Spreads marks by `radius` along one line.
void spreadLine(const std::uint8_t* in, std::uint8_t* out, int count, int stride, int radius) {
  int reach = -1;  // marked up to here by what lies before
  for (int i = 0; i < count; ++i) {
    if (in[i * stride] != 0) {
      for (int k = std::max({0, i - radius, reach}); k < i; ++k) out[k * stride] = 1;
      reach = i + radius;
    }
    if (i <= reach) out[i * stride] = 1;
  }
}

}  // namespace

Raster<std::uint8_t> spread(const Raster<std::uint8_t>& marks, int radius_px) {
  const int width = marks.width_px, height = marks.height_px;
  Raster<std::uint8_t> rows(width, height, 0), out(width, height, 0);
  parallelRows(height, [&](int v) { spreadLine(marks.row(v), rows.row(v), width, 1, radius_px); });
  parallelRanges(width, 64, [&](int begin, int end) {
    for (int u = begin; u < end; ++u)
      spreadLine(rows.values.data() + u, out.values.data() + u, height, width, radius_px);
  });
  return out;
}

}  // namespace softscope
