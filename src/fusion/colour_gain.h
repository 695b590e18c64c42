// src/fusion/colour_gain.h: how much brighter the new picture is than the model.
#pragma once

#include "core/point_model.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// image = colour of the model * gain, channel by channel: docs/fusion.md (F11).
struct ColourGain {
  float red = 1, green = 1, blue = 1;
};

/// The median over the points that are seen, highlights and dark pixels left out; bounded to
/// 1/2 … 2. 1 where fewer than 100 points speak, there is no picture, or the option is off.
ColourGain estimateGain(const PointModel& model, const Observation& observation,
                        const Visibility& visibility, const ColourOptions& options);

/// The pixel's colour as the model keeps it: without gain.
Rgb8 modelColour(Rgb8 seen, const ColourGain& gain);

/// Whether the pixel shows the light, not the tissue: (F13).
inline bool isHighlight(Rgb8 seen, const ColourOptions& options) {
  return seen.red >= options.highlight_level && seen.green >= options.highlight_level &&
         seen.blue >= options.highlight_level;
}

}  // namespace softscope
