// src/io/datasets/surgt_files.h: info.yaml and gt_rectified_N.yaml of SurgT.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// info.yaml.
struct SurgtInfo {
  bool side_by_side = false;        // video_stack horizontal; else vertical, left on top
  int width_px = 0, height_px = 0;  // of one view
  std::string video;                // name within the folder
  std::vector<std::string> truth;   // file names of true boxes, one per target
};

/// Throws InputError: a missing key, an unknown stacking,
/// an implausible size, a name outside of the folder.
SurgtInfo readSurgtInfo(const std::filesystem::path& file);
SurgtInfo parseSurgtInfo(std::string_view text, const std::string& name);
std::string surgtInfoYaml(const SurgtInfo& info);

/// One frame of a target: u, v (upper left corner), width, height in rectified px.
struct SurgtFrame {
  bool visible_in_both = false;
  bool difficult = false;
  std::optional<std::array<std::array<double, 4>, 2>> boxes;  // left, right
};

/// Throws InputError with the frame of the error.
std::vector<SurgtFrame> readSurgtTruth(const std::filesystem::path& file);
std::vector<SurgtFrame> parseSurgtTruth(std::string_view text, const std::string& name);
std::string surgtTruthYaml(const std::vector<SurgtFrame>& frames);

}  // namespace softscope
