// vtk_views/drawing/figure_style.h: sizes and fonts of figures by journal.
#pragma once

#include <string>

namespace softscope {

struct FigureStyle {
  std::string name = "ieee";
  double width_mm = 89;
  double font_pt = 7.5;
  double line_pt = 0.9;  // width of contours; frames and bars are proportional
  double dots_per_inch = 600;
};

/// ieee, nature, elsevier (one column each) or slides. Throws OptionError for another name.
FigureStyle figureStyle(const std::string& name);

}  // namespace softscope
