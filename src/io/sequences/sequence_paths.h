// src/io/sequences/sequence_paths.h: paths of the parts of a sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope {

/// left and right: an image, a folder of images or a video each; or stereo: the same with
/// both views in one image. right is optional with depth; all three are optional with depth.
struct SequencePaths {
  std::filesystem::path left, right;
  std::filesystem::path stereo;
  std::filesystem::path calibration;  // file, or folder with a calibration
  std::filesystem::path mask;         // folder or image; empty = none
  bool tissue_masks = false;          // mask is a folder as in io/sequences/tissue_masks.h
  void setMask(const std::filesystem::path& given) {
    mask = given;
    tissue_masks = false;
  }
  std::filesystem::path depth;       // folder or file; empty = none
  std::filesystem::path timestamps;  // file; empty = none
  // For data sets whose folders contain other files, or views
  // with missing images: the paired files, equally many of each.
  // left, right and depth are then the folders in messages.
  std::vector<std::filesystem::path> left_files, right_files, depth_files;
  std::vector<double> times_s;  // one per file as above; empty = none
  std::string form;             // of a data set: "SurgT"; empty = docs/formats.md
  double depth_unit_mm = 0;     // step of 16-bit depth; 0: from the calibration
  bool rectified = false;       // overrides the calibration: the images are rectified
  std::string layout;           // of `stereo`, if the folder defines it; an option not auto wins
};

/// Parts of a sequence folder (docs/formats.md): left/ and right/,
/// else left.* and right.* videos, else one stereo.* video; mask/,
/// depth/ and timestamps.txt if present. Or a clip of a known data set
/// (io/sequences/dataset_form.h). Throws InputError for missing views.
SequencePaths findSequence(const std::filesystem::path& folder);

/// By file extension.
bool isVideo(const std::filesystem::path& file);
bool isPicture(const std::filesystem::path& file);

}  // namespace softscope
