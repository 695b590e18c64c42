// vtk_views/drawing/figure_style.h: what a journal asks of a figure.
#pragma once

#include <string>
#include <vector>

namespace softscope {

struct FigureStyle {
  std::string name = "ieee";
  double width_mm = 89;
  double font_pt = 7.5;
  double line_pt = 0.9;  // of contours; frames and bars follow it
  double dots_per_inch = 600;
};

/// ieee, nature, elsevier (one column each), slides.
std::vector<std::string> figureStyleNames();

/// Throws OptionError for a name that isn't one of these.
FigureStyle figureStyle(const std::string& name);

}  // namespace softscope
