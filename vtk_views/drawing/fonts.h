// vtk_views/drawing/fonts.h: typeface of figures.
#pragma once

#include <string>

namespace softscope {

struct FontFile {
  std::string family;  // result of fontconfig; may differ from the requested family
  std::string path;    // empty without any font
};

/// Font file that fontconfig selects for `family`. Never throws.
FontFile findFont(const std::string& family);

/// Font family of all figures: Arial or Helvetica, as journals require, if
/// installed; else Liberation Sans, which has the same widths; else DejaVu
/// Sans. All have Greek, arrows and ±. Constant during the process.
const std::string& figureFont();
/// True for a family with the widths of Arial.
bool figureFontHasArialsWidths();

}  // namespace softscope
