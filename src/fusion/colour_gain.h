// src/fusion/colour_gain.h: brightness gain between model and image.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/hd.h"
#include "core/point_model.h"
#include "fusion/colour_levels.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// image = colour of the model * gain, per channel: docs/fusion.md (F11).
struct ColourGain {
  float red = 1, green = 1, blue = 1;
};

/// Median over the visible points, without highlights and dark pixels; bounded to
/// 1/2 … 2. 1 with fewer than 100 points, without an image, or with the option off.
ColourGain estimateGain(const PointModel& model, const Observation& observation,
                        const Visibility& visibility, const ColourOptions& options);

/// Colour of the pixel as stored in the model: without gain.
SOFTSCOPE_HD inline Rgb8 modelColour(Rgb8 seen, const ColourGain& gain) {
  return scaled(seen, 1 / gain.red, 1 / gain.green, 1 / gain.blue);
}

/// Whether the pixel is a specular highlight: (F13).
SOFTSCOPE_HD inline bool isHighlight(Rgb8 seen, const ColourOptions& options) {
  return seen.red >= options.highlight_level && seen.green >= options.highlight_level &&
         seen.blue >= options.highlight_level;
}

/// A median of ratios is taken from counts of log2(ratio), from -2 to 2; 1 is the middle of a bin.
constexpr int kGainBins = 512;
/// Bin of one channel of a point; -1 for an unusable ratio.
int gainBin(std::uint8_t seen, std::uint8_t known);
/// Whether a colour is usable for the gain: not dark, not saturated, no highlight.
SOFTSCOPE_HD inline bool isUsableForGain(Rgb8 colour, const ColourOptions& options) {
  constexpr int kDarkest = 16;  // quantisation limit
  const auto inside = [](int level) { return level >= kDarkest && level < 250; };
  return inside(colour.red) && inside(colour.green) && inside(colour.blue) &&
         !isHighlight(colour, options);
}
/// Gain of one channel from its counts.
float gainOf(const int* counts);
/// Every n-th point of a model of that size is compared:
/// an even subset is sufficient for the median.
inline std::size_t gainStride(std::size_t points) {
  constexpr std::size_t kMostPoints = 20000;
  return 1 + points / kMostPoints;
}

}  // namespace softscope
