// vtk_views/drawing/fonts.h: typeface of figures.
#pragma once

#include <string>

namespace softscope {

struct FontFile {
  std::string family;  // what fontconfig answers with; may differ from what was asked
  std::string path;    // empty where the machine has no font at all
};

/// The file that fontconfig takes for `family`. Never throws.
FontFile findFont(const std::string& family);

/// The family that every figure is set in: Arial or Helvetica, as journals ask, where installed;
/// else Liberation Sans, whose letters are as wide; else DejaVu Sans. All have Greek, arrows and ±.
/// The same for the whole life of the process.
const std::string& figureFont();
/// Whether it is one of those that journals ask for, or as wide: figures then look alike.
bool figureFontHasArialsWidths();

}  // namespace softscope
