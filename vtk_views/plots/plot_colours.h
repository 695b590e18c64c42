// vtk_views/plots/plot_colours.h: line colours of all plots (Okabe and Ito).
#pragma once

#include "core/image.h"

namespace softscope {

inline constexpr Rgb8 kPlotBlue{0, 114, 178}, kPlotVermilion{213, 94, 0};
inline constexpr Rgb8 kBarBlue{190, 212, 232};  // bars up to a P95

}  // namespace softscope
