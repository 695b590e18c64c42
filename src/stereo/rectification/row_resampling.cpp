#include "stereo/rectification/row_resampling.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "stereo/kernels/stereo_kernels.h"

namespace softscope {
namespace {

/// Source of the pixels of row v, in 1 / kRowPhases of a row, inside the image.
void findSources(const RowAlignment& alignment, int v, int height, int width, int* source) {
  const float scale = static_cast<float>(1 / alignment.half_width_px);
  const float centre = static_cast<float>(alignment.centre_u_px);
  const float y = static_cast<float>(v - alignment.centre_v_px) * scale;
  float m[6];
  for (std::size_t k = 0; k < 6; ++k) m[k] = static_cast<float>(alignment.model[k]);
  const float constant = static_cast<float>(v) + m[0] + y * (m[2] + y * m[5]);
  const float linear = m[1] + y * m[4], quadratic = m[3];
  const float last = static_cast<float>(height - 1);
  for (int u = 0; u < width; ++u) {
    const float x = (static_cast<float>(u) - centre) * scale;
    const float row = std::min(std::max(constant + x * (linear + x * quadratic), 0.0f), last);
    source[u] = static_cast<int>(row * kRowPhases + 0.5f);
  }
}

/// The first pixel from `begin` on whose source is in another row.
int endOfRun(const std::vector<int>& source, int begin) {
  const int row = source[static_cast<std::size_t>(begin)] / kRowPhases;
  const auto end = std::find_if(source.begin() + begin, source.end(),
                                [row](int other) { return other / kRowPhases != row; });
  return static_cast<int>(end - source.begin());
}

template <class Pixel>
Raster<Pixel> move(const Raster<Pixel>& picture, const RowAlignment& alignment) {
  constexpr int kChannels = sizeof(Pixel);  // of bytes
  const int width = picture.width_px, last = picture.height_px - 1;
  Raster<Pixel> moved(width, picture.height_px);
  const auto bytesAt = [&](int u, int v) {
    return reinterpret_cast<const std::uint8_t*>(picture.row(std::clamp(v, 0, last)) + u);
  };
  parallelRanges(picture.height_px, 32, [&, width, last](int begin, int end) {
    std::vector<int> source(static_cast<std::size_t>(width));
    std::vector<std::uint8_t> phase(source.size() * kChannels);
    for (int v = begin; v < end; ++v) {
      findSources(alignment, v, last + 1, width, source.data());
      for (std::size_t i = 0; i < phase.size(); ++i)
        phase[i] = static_cast<std::uint8_t>(source[i / kChannels] % kRowPhases);
      for (int u = 0; u < width;) {
        const int next = endOfRun(source, u);
        const int row = source[static_cast<std::size_t>(u)] / kRowPhases;
        const std::uint8_t* const rows[] = {bytesAt(u, row - 1), bytesAt(u, row),
                                            bytesAt(u, row + 1), bytesAt(u, row + 2)};
        resamplingKernels().mixRows(rows, phase.data() + kChannels * u, kChannels * (next - u),
                                    reinterpret_cast<std::uint8_t*>(moved.row(v) + u));
        u = next;
      }
    }
  });
  return moved;
}

}  // namespace

GrayImage moveRows(const GrayImage& picture, const RowAlignment& alignment) {
  return move(picture, alignment);
}

ColourImage moveRows(const ColourImage& picture, const RowAlignment& alignment) {
  return move(picture, alignment);
}

Mask moveMaskRows(const Mask& mask, const RowAlignment& alignment) {
  if (mask.empty()) return {};
  Mask marks = dilated(mask, 1);  // the cubic weights of farther rows are small and negative
  for (std::uint8_t& value : marks.values) value = value == 0 ? 0 : 255;
  return moveRows(marks, alignment);
}

}  // namespace softscope
