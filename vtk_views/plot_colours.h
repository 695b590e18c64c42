// vtk_views/plot_colours.h: the lines of every plot; told apart by all eyes (Okabe and Ito).
#pragma once

#include "core/image.h"

namespace softscope {

inline constexpr Rgb8 kPlotBlue{0, 114, 178}, kPlotVermilion{213, 94, 0};

}  // namespace softscope
