// vtk_views/volumes/grey_window.h: window and level of a volume.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "vtk_views/volumes/volume.h"

namespace softscope {

/// Mid-grey at `level`; black and white at half a `width` from it.
struct GreyWindow {
  std::string name;  // "soft tissue"; empty for numbers
  double width = 400;
  double level = 40;

  std::uint8_t grey(double value) const;
};

/// Names that parseWindow() accepts.
std::vector<std::string> windowNames();

/// "auto", "soft-tissue", "lung", "bone", "liver", "vessels", or "WIDTH,LEVEL". Named
/// windows are in Hounsfield units. "auto" is soft tissue for a volume in Hounsfield
/// units, else the central 98 % of its values. Throws OptionError: an unknown name, a
/// width that is not positive, or Hounsfield units for another volume.
GreyWindow parseWindow(const std::string& text, const Volume& volume);

}  // namespace softscope
