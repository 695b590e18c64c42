// vtk_views/volumes/grey_window.h: window and level of a volume.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// Values at `level` are mid-grey; black and white are half a `width` away.
struct GreyWindow {
  std::string name;  // "soft tissue"; empty where given as numbers
  double width = 400;
  double level = 40;

  std::uint8_t grey(double value) const;
};

/// Names that parseWindow() accepts.
std::vector<std::string> windowNames();

/// "auto", "soft-tissue", "lung", "bone", "liver", "vessels", or "WIDTH,LEVEL". The named ones are
/// in Hounsfield units. "auto" is soft tissue for a volume in these, else the middle 98 % of its
/// values. Throws OptionError: an unknown name, a width that isn't above 0, or Hounsfield units
/// wanted of a volume that doesn't hold them.
GreyWindow parseWindow(const std::string& text, const Volume& volume);

}  // namespace softscope
