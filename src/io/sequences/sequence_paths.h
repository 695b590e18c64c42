// src/io/sequences/sequence_paths.h: paths of the parts of a sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope {

/// left and right: each an image, a folder of images or a video. Or stereo: the same, with both
/// views in one image. right may be empty where depth is given, and all three may then be.
struct SequencePaths {
  std::filesystem::path left, right;
  std::filesystem::path stereo;
  std::filesystem::path calibration;  // a file, or a folder that holds one
  std::filesystem::path mask;         // a folder or an image; empty = none
  std::filesystem::path depth;        // a folder or a file; empty = none
  std::filesystem::path timestamps;   // a file; empty = none
  // Of a data set whose folder holds more than the view's images, or views that lack images: those
  // that belong together, as many of each. Where they are given, left, right and depth are the
  // folders that messages name.
  std::vector<std::filesystem::path> left_files, right_files, depth_files;
  std::vector<double> times_s;  // likewise; empty = none
  std::string form;          // of the data set, where it is one: "SurgT"; empty = docs/formats.md
  double depth_unit_mm = 0;  // one step of 16-bit depth; 0: as the calibration says
  bool rectified = false;    // the images are, whatever the calibration says
  std::string layout;  // of `stereo`, where the folder says it; an option that isn't auto wins
};

/// The parts of a sequence folder (docs/formats.md): left/ and right/, else left.* and right.*
/// videos, else one stereo.* video; mask/, depth/ and timestamps.txt where they exist. Or a clip of
/// a known data set as it is shipped (io/sequences/dataset_form.h).
/// Throws InputError where the views are missing.
SequencePaths findSequence(const std::filesystem::path& folder);

/// By extension.
bool isVideo(const std::filesystem::path& file);
bool isPicture(const std::filesystem::path& file);

}  // namespace softscope
