#include "stereo/images/gradient_image.h"

#include <algorithm>
#include <cstring>

#include "core/mask_morphology.h"
#include "core/parallel.h"
#include "stereo/images/view_masks.h"
#include "stereo/kernels/matching_formulas.h"
#include "stereo/kernels/stereo_kernels.h"

namespace softscope {
namespace {

/// Copies a row with its first and last pixel doubled.
void padRow(const std::uint8_t* row, int width, std::vector<std::uint8_t>& padded) {
  padded.resize(static_cast<std::size_t>(width) + 2);
  std::memcpy(padded.data() + 1, row, static_cast<std::size_t>(width));
  padded.front() = row[0];
  padded.back() = row[width - 1];
}

}  // namespace

GradientImage::GradientImage(const GrayImage& image, double gain, int margin_px, const Mask& mask)
    : width_px_(image.width_px), height_px_(image.height_px), mask_(mask) {
  const int side = (margin_px + 2 * kTileWidth + 63) / 64 * 64;
  stride_ = (width_px_ + 2 * side + 63) / 64 * 64;
  origin_ = static_cast<std::size_t>(kRowMargin) * stride_ + side;
  constexpr std::uint16_t kFlat = 128 + 256 * 128;
  packed_.assign(static_cast<std::size_t>(height_px_ + 2 * kRowMargin) * stride_, kFlat);
  const MatchingKernels& kernels = matchingKernels();
  const int gain_q8 = gainQ8(gain);
  parallelRanges(height_px_, 32, [&](int begin, int end) {
    std::vector<std::uint8_t> rows[3];
    for (int v = begin; v < end; ++v) {
      for (int k = 0; k < 3; ++k)
        padRow(image.row(std::clamp(v + k - 1, 0, height_px_ - 1)), width_px_, rows[k]);
      const std::size_t at = origin_ + static_cast<std::size_t>(v) * stride_;
      kernels.sobelRow(rows[0].data() + 1, rows[1].data() + 1, rows[2].data() + 1, width_px_,
                       gain_q8, packed_.data() + at);
    }
  });
}

Mask GradientImage::blocked(int reach_px) const { return dilated(mask_, reach_px + kSobelReach); }

GradientView GradientImage::view(int first_row) const {
  const auto shift = static_cast<std::ptrdiff_t>(first_row) * stride_;
  return {packed_.data() + origin_ + shift, stride_};
}

}  // namespace softscope
