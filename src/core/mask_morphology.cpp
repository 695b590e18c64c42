#include "core/mask_morphology.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"

namespace softscope {
namespace {

void addRow(const std::uint8_t* from, int width, std::uint8_t* to) {
  for (int u = 0; u < width; ++u) to[u] |= from[u];
}

/// out[u] = 1 if one of in[u - radius .. u + radius] is marked; `padded` is scratch memory.
void dilateRow(const std::uint8_t* in, int width, int radius, std::vector<std::uint8_t>& padded,
               std::uint8_t* out) {
  padded.assign(static_cast<std::size_t>(width + 2 * radius), 0);
  std::copy_n(in, width, padded.begin() + radius);
  for (int k = 0; k <= 2 * radius; ++k) addRow(padded.data() + k, width, out);
}

/// `marks` are 0 or 1.
Mask dilatedMarks(const Mask& marks, int radius_px) {
  const int width = marks.width_px, height = marks.height_px;
  Mask rows(width, height, 0), out(width, height, 0);
  parallelRanges(height, 32, [&](int begin, int end) {
    std::vector<std::uint8_t> padded;
    for (int v = begin; v < end; ++v)
      dilateRow(marks.row(v), width, radius_px, padded, rows.row(v));
  });
  parallelRows(height, [&](int v) {
    for (int y = std::max(v - radius_px, 0); y <= std::min(v + radius_px, height - 1); ++y)
      addRow(rows.row(y), width, out.row(v));
  });
  return out;
}

}  // namespace

Mask dilated(const Mask& mask, int radius_px) {
  Mask marks = mask;
  for (std::uint8_t& value : marks.values) value = value != 0;
  return dilatedMarks(marks, radius_px);
}

Mask eroded(const Mask& mask, int radius_px) {
  Mask holes = mask;
  for (std::uint8_t& value : holes.values) value = value == 0;
  Mask out = dilatedMarks(holes, radius_px);
  for (std::uint8_t& value : out.values) value = value == 0;
  return out;
}

}  // namespace softscope
