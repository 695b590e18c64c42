#include "stereo/refinement/plane.h"

#include <algorithm>

#include "core/parallel.h"
#include "stereo/kernels/stereo_kernels.h"
#include "stereo/refinement/refinement_window.h"

namespace softscope {
namespace {

/// Filters a band of rows from top to bottom; only the rows of the window are held.
class BrightnessSplitter {
 public:
  BrightnessSplitter(const GrayImage& image, const std::vector<float>& slow)
      : image_(image),
        slow_(slow),
        taps_(static_cast<int>(slow.size())),
        reach_(taps_ / 2),
        padded_(static_cast<std::size_t>(image.width_px + 2 * reach_ + kLanes)),
        slow_rows_(image.width_px, taps_, 0, 0),
        smooth_rows_(image.width_px, taps_, 0, 0) {}

  void split(int begin, int end, BrightnessParts& out) {
    for (int v = begin - reach_; v < end + reach_; ++v) {
      filterRow(v);
      if (v - reach_ >= begin)
        combineRows(v - reach_, out.fast.row(v - reach_), out.slow.row(v - reach_));
    }
  }

 private:
  static constexpr int kLanes = 8;  // number of values per kernel step
  int slot(int v) const { return (v + taps_) % taps_; }

  /// Both filters along row v, with the border repeated outside of the image.
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

  /// The low-pass rows around v, and the smooth ones minus their sum.
  void combineRows(int v, float* fast, float* slow) {
    const RefinementKernels& kernels = refinementKernels();
    const int width = image_.width_px;
    std::vector<const float*> rows;
    for (int y = -reach_; y <= reach_; ++y) rows.push_back(slow_rows_.row(slot(v + y)));
    kernels.sumRows(rows.data(), slow_.data(), taps_, width, slow);
    const float weights[] = {kBinomialWeights[0], kBinomialWeights[1], kBinomialWeights[2], -1};
    const float* const parts[] = {smooth_rows_.row(slot(v - 1)), smooth_rows_.row(slot(v)),
                                  smooth_rows_.row(slot(v + 1)), slow};
    kernels.sumRows(parts, weights, 4, width, fast);
    repeatBorder(fast);
    repeatBorder(slow);
  }
  void repeatBorder(float* row) const {
    const int width = image_.width_px;
    row[-1] = row[-2] = row[0];
    row[width] = row[width + 1] = row[width + 2] = row[width - 1];
  }

  const GrayImage& image_;
  const std::vector<float>& slow_;
  int taps_, reach_;
  std::vector<float> padded_;
  Plane slow_rows_, smooth_rows_;
};

}  // namespace

BrightnessParts splitBrightness(const GrayImage& image, double sigma_px) {
  constexpr int kBandRows = 60;
  const std::vector<float> slow = slowBrightnessWeights(sigma_px);
  BrightnessParts out{Plane(image.width_px, image.height_px),
                      Plane(image.width_px, image.height_px)};
  parallelRanges(image.height_px, kBandRows, [&](int begin, int end) {
    BrightnessSplitter(image, slow).split(begin, end, out);
  });
  return out;
}

}  // namespace softscope
