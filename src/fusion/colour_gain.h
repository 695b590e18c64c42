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

/// image = colour of the model * gain, channel by channel: docs/fusion.md (F11).
struct ColourGain {
  float red = 1, green = 1, blue = 1;
};

/// The median over the points that are seen, highlights and dark pixels left out; bounded to
/// 1/2 … 2. 1 with fewer than 100 points, without an image, or with the option off.
ColourGain estimateGain(const PointModel& model, const Observation& observation,
                        const Visibility& visibility, const ColourOptions& options);

/// The pixel's colour as the model keeps it: without gain.
SOFTSCOPE_HD inline Rgb8 modelColour(Rgb8 seen, const ColourGain& gain) {
  return scaled(seen, 1 / gain.red, 1 / gain.green, 1 / gain.blue);
}

/// Whether the pixel shows the light, not the tissue: (F13).
SOFTSCOPE_HD inline bool isHighlight(Rgb8 seen, const ColourOptions& options) {
  return seen.red >= options.highlight_level && seen.green >= options.highlight_level &&
         seen.blue >= options.highlight_level;
}

/// A median of ratios is taken from counts of log2(ratio), from -2 to 2; 1 is the middle of a bin.
constexpr int kGainBins = 512;
/// The bin of one channel of a point; -1 where the ratio counts for nothing.
int gainBin(std::uint8_t seen, std::uint8_t known);
/// Whether a colour is usable for the gain: not dark, not saturated, no highlight.
SOFTSCOPE_HD inline bool tellsGain(Rgb8 colour, const ColourOptions& options) {
  constexpr int kDarkest = 16;  // below it quantisation spoils the ratio
  const auto inside = [](int level) { return level >= kDarkest && level < 250; };
  return inside(colour.red) && inside(colour.green) && inside(colour.blue) &&
         !isHighlight(colour, options);
}
/// The gain of one channel by its counts.
float gainOf(const int* counts);
/// Every n-th point of a model of that size is compared, from the first on: an even subset tells
/// the median well enough.
inline std::size_t gainStride(std::size_t points) {
  constexpr std::size_t kMostPoints = 20000;
  return 1 + points / kMostPoints;
}

}  // namespace softscope
