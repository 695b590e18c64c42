// src/core/length_unit.h: units of the lengths in files.
#pragma once

#include <string>
#include <string_view>

namespace softscope {

/// Unit of the lengths in a file.
struct LengthUnit {
  std::string name = "mm";
  double mm = 1;  // length of the unit
};

/// `requested_mm` if it is above 0; else what the header of the file states as `unit mm`, `unit cm`
/// or `unit m`, as `softscope export` does; else 1.
double unitOfFileMm(double requested_mm, std::string_view header);

}  // namespace softscope
