// src/io/geometry/trajectory_file.h: camera path as TUM lines, time_s tx ty tz qx qy qz qw.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/trajectory.h"

namespace softscope {

/// world_from_left, translation in mm. Lines that begin with # and empty ones are
/// skipped. Throws InputError with the line: not eight finite numbers, a quaternion
/// whose length differs from 1 by more than 1 %, a decreasing time, no pose.
Trajectory readTrajectory(const std::filesystem::path& file);
Trajectory parseTrajectory(std::string_view text, const std::string& name);

/// Times with 6 decimals, mm with 6, quaternions with 9.
std::string trajectoryText(const Trajectory& trajectory);

/// KITTI format: one line per pose, the 3 x 4 matrix world_from_left
/// row by row, mm. Poses rounded as in trajectoryText().
std::string kittiText(const Trajectory& trajectory);

/// Throws OptionError if the file exists and `overwrite` is false,
/// Error if it cannot be written or a number is not finite.
void writeTrajectory(const std::filesystem::path& file, const Trajectory& trajectory,
                     bool overwrite = false);

}  // namespace softscope
