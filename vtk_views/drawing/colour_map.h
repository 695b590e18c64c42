// vtk_views/drawing/colour_map.h: perceptually ordered colour map.
#pragma once

#include "core/image.h"

namespace softscope {

/// The viridis map (van der Walt and Smith, 2015; CC0): lightness rises evenly, so it is readable
/// in grey and with colour blindness. `position` from 0 (dark blue) to 1 (yellow), clamped.
Rgb8 viridis(double position);

/// Linear interpolation from a (part 0) to b (part 1), per channel.
Rgb8 blend(const Rgb8& a, const Rgb8& b, double part);

/// Colour of unmeasured and masked pixels: neutral, outside of the colour map.
inline constexpr Rgb8 kUnmeasuredGrey{200, 200, 200};
inline constexpr Rgb8 kMaskedGrey{110, 110, 110};

}  // namespace softscope
