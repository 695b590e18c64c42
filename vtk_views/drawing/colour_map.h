// vtk_views/drawing/colour_map.h: perceptually ordered colour map.
#pragma once

#include "core/image.h"

namespace softscope {

/// The viridis map (van der Walt and Smith, 2015; CC0): lightness rises evenly, readable in grey
/// and by the colour-blind. `position` runs from 0, dark blue, to 1, yellow; outside it is clamped.
Rgb8 viridis(double position);

/// From a (part 0) to b (part 1), channel by channel.
Rgb8 blend(const Rgb8& a, const Rgb8& b, double part);

/// For what was not measured, and for what a mask excludes: neutral, so never taken for a value.
inline constexpr Rgb8 kUnmeasuredGrey{200, 200, 200};
inline constexpr Rgb8 kMaskedGrey{110, 110, 110};

}  // namespace softscope
