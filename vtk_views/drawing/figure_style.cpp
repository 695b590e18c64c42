// vtk_views/drawing/figure_style.cpp: widths and
// font sizes from the guides of the publishers.
#include "vtk_views/drawing/figure_style.h"

#include <vector>

#include "core/error.h"

namespace softscope {
namespace {

const std::vector<FigureStyle>& styles() {
  static const std::vector<FigureStyle> kStyles{{"ieee", 88.9, 7.5, 0.9, 600},
                                                {"nature", 89, 6.5, 0.75, 600},
                                                {"elsevier", 90, 7, 0.9, 600},
                                                {"slides", 254, 14, 2, 200}};
  return kStyles;
}

}  // namespace

FigureStyle figureStyle(const std::string& name) {
  for (const FigureStyle& style : styles())
    if (style.name == name) return style;
  std::string known;
  for (const FigureStyle& style : styles()) known += (known.empty() ? "" : ", ") + style.name;
  throw OptionError("`style=` is `" + name + "`, but must be one of " + known);
}

}  // namespace softscope
