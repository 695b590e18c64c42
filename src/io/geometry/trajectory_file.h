// src/io/geometry/trajectory_file.h: the scope's path as TUM lines, time_s tx ty tz qx qy qz qw.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/trajectory.h"

namespace softscope {

/// world_from_left, translation in mm. Lines that begin with # and empty ones are skipped.
/// Throws InputError with the line: not eight finite numbers, a quaternion whose length is more
/// than 1 % from 1, a time before the line above, no pose at all.
Trajectory readTrajectory(const std::filesystem::path& file);
Trajectory parseTrajectory(std::string_view text, const std::string& name);

/// Times with 6 digits after the point, mm with 6, quaternions with 9.
std::string trajectoryText(const Trajectory& trajectory);

/// KITTI's form: a line per pose, the 3 x 4 matrix world_from_left row by row, mm. The poses are
/// those that trajectoryText() gives back when it is read.
std::string kittiText(const Trajectory& trajectory);

/// Throws OptionError where the file exists and `overwrite` is false, Error where it can't be
/// written or a number isn't finite.
void writeTrajectory(const std::filesystem::path& file, const Trajectory& trajectory,
                     bool overwrite = false);

}  // namespace softscope
