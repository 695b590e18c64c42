// src/io/datasets/stereomis_files.h: StereoMIS' groundtruth.txt and its splits.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/frame_range.h"
#include "core/trajectory.h"

namespace softscope {

/// By frame: world_from_left, mm, of the raw left camera; from lines `frame tx ty tz qx qy qz qw`.
/// Throws InputError: a line of another form, a frame that is no whole number or comes twice.
std::map<int, Eigen::Isometry3d> readStereoMisPath(const std::filesystem::path& file);
std::map<int, Eigen::Isometry3d> parseStereoMisPath(std::string_view text, const std::string& name);

/// Ranges of frames, a line `start,end` each; the end is not part of it. Throws InputError.
std::vector<FrameRange> readStereoMisSplit(const std::filesystem::path& file);
std::vector<FrameRange> parseStereoMisSplit(std::string_view text, const std::string& name);

}  // namespace softscope
