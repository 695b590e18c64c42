// src/core/length_unit.h: units of the lengths in files.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Unit of the lengths in a file.
struct LengthUnit {
  std::string name = "mm";
  double mm = 1;  // length of the unit
};

/// mm, cm or m; none for other names.
std::optional<LengthUnit> lengthUnitNamed(std::string_view name);

/// Requests the unit that a file states.
inline constexpr double kUnitOfFile = std::numeric_limits<double>::quiet_NaN();

/// `requested_mm`, the length of one unit of a file; for kUnitOfFile what its header states as
/// `unit mm`, `unit cm` or `unit m`, as `softscope export` does, else 1.
double unitOfFileMm(double requested_mm, std::string_view header);

/// From units of this length.
void toMillimetres(double unit_mm, std::vector<Eigen::Vector3f>* positions);

}  // namespace softscope
