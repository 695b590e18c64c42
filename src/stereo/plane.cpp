#include "stereo/plane.h"

#include <algorithm>

#include "core/parallel.h"
#include "stereo/kernel_sets.h"
#include "stereo/refinement_window.h"

namespace softscope {
namespace {

/// Filters a band of rows from top to bottom; only the rows that the window needs are held.
class BandPass {
 public:
  BandPass(const GrayImage& image, const std::vector<float>& slow)
      : image_(image),
        slow_(slow),
        taps_(static_cast<int>(slow.size())),
        reach_(taps_ / 2),
        padded_(static_cast<std::size_t>(image.width_px + 2 * reach_ + kLanes)),
        slow_rows_(image.width_px, taps_, 0, 0),
        smooth_rows_(image.width_px, taps_, 0, 0) {}

  void filter(int begin, int end, Plane& out) {
    for (int v = begin - reach_; v < end + reach_; ++v) {
      filterRow(v);
      if (v - reach_ >= begin) combineRows(v - reach_, out.row(v - reach_));
    }
  }

 private:
  static constexpr int kLanes = 8;  // kernels work on so many values at a time
  int slot(int v) const { return (v + taps_) % taps_; }

  /// Both filters along row v, the border repeated beyond the picture.
  void filterRow(int v) {
    const std::uint8_t* row = image_.row(std::clamp(v, 0, image_.height_px - 1));
    float* padded = padded_.data();
    std::fill_n(padded, reach_, static_cast<float>(row[0]));
    std::copy_n(row, image_.width_px, padded + reach_);
    std::fill_n(padded + reach_ + image_.width_px, reach_ + kLanes,
                static_cast<float>(row[image_.width_px - 1]));
    std::vector<const float*> shifted;
    for (int t = 0; t < taps_; ++t) shifted.push_back(padded + t);
    const RefinementKernels& kernels = refinementKernels();
    kernels.sumRows(shifted.data(), slow_.data(), taps_, image_.width_px, slow_rows_.row(slot(v)));
    kernels.sumRows(&shifted[static_cast<std::size_t>(reach_ - 1)], kBinomialWeights, 3,
                    image_.width_px, smooth_rows_.row(slot(v)));
  }

  /// The smooth rows around v minus the slow ones.
  void combineRows(int v, float* out) {
    std::vector<const float*> rows;
    std::vector<float> weights(kBinomialWeights, kBinomialWeights + 3);
    for (int y = -1; y <= 1; ++y) rows.push_back(smooth_rows_.row(slot(v + y)));
    for (int y = -reach_; y <= reach_; ++y) {
      rows.push_back(slow_rows_.row(slot(v + y)));
      weights.push_back(-slow_[static_cast<std::size_t>(y + reach_)]);
    }
    const int width = image_.width_px;
    refinementKernels().sumRows(rows.data(), weights.data(), static_cast<int>(rows.size()), width,
                                out);
    out[-1] = out[-2] = out[0];
    out[width] = out[width + 1] = out[width + 2] = out[width - 1];
  }

  const GrayImage& image_;
  const std::vector<float>& slow_;
  int taps_, reach_;
  std::vector<float> padded_;
  Plane slow_rows_, smooth_rows_;
};

}  // namespace

Plane bandPass(const GrayImage& image, double highpass_sigma_px) {
  constexpr int kBandRows = 60;
  const std::vector<float> slow = slowBrightnessWeights(highpass_sigma_px);
  Plane out(image.width_px, image.height_px);
  parallelRanges(image.height_px, kBandRows,
                 [&](int begin, int end) { BandPass(image, slow).filter(begin, end, out); });
  return out;
}

}  // namespace softscope
