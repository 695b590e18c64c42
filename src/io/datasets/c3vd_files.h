// src/io/datasets/c3vd_files.h: pose.txt and depth step of C3VD.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Step of the 16-bit depth; the last one, 100 mm, also stands for larger depths.
inline constexpr double kC3vdStepMm = 100.0 / 65535;

/// world_from_left per image, mm; lines of 16 numbers, a 4 x 4 matrix column by column (number 13
/// to 15: translation) or row by row (number 4, 8, 12), distinguished by its row 0 0 0 1; column by
/// column if both are possible. Throws InputError with the line: not 16 finite numbers, no such
/// row, lines in different orders, no rotation.
std::vector<Eigen::Isometry3d> readC3vdPath(const std::filesystem::path& file);
std::vector<Eigen::Isometry3d> parseC3vdPath(std::string_view text, const std::string& name);

/// Column by column.
std::string c3vdPathText(const std::vector<Eigen::Isometry3d>& world_from_left);

}  // namespace softscope
