// vtk_views/drawing/fonts.h: which typeface our figures are set in.
#pragma once

#include <string>

namespace softscope {

/// The family that every figure asks for; it has Greek, arrows and ± (VTK's own face hasn't).
inline constexpr const char* kFontFamily = "DejaVu Sans";

struct FontFile {
  std::string family;  // what fontconfig answers with; may differ from what was asked
  std::string path;    // empty where the machine has no font at all
};

/// The file that fontconfig takes for `family`. Never throws.
FontFile findFont(const std::string& family = kFontFamily);

}  // namespace softscope
