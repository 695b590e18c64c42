// src/io/datasets/stereomis_files.h: groundtruth.txt and splits of StereoMIS.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/frame_range.h"
#include "core/trajectory.h"

namespace softscope {

/// By frame: world_from_left, mm, of the raw left camera; from lines `frame tx ty tz qx qy qz qw`,
/// in metres; in mm if a place is farther than 1 from the first one. Throws InputError: an invalid
/// line, an invalid or duplicate frame number.
std::map<int, Eigen::Isometry3d> readStereoMisPath(const std::filesystem::path& file);
std::map<int, Eigen::Isometry3d> parseStereoMisPath(std::string_view text, const std::string& name);

/// Frame ranges, one line `start,end` each; `end` is exclusive. Throws InputError.
std::vector<FrameRange> readStereoMisSplit(const std::filesystem::path& file);
std::vector<FrameRange> parseStereoMisSplit(std::string_view text, const std::string& name);

}  // namespace softscope
