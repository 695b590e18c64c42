// src/io/sequences/shipped_folders.h: data sets
// of image folders, or of a video with tables.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/sequences/dataset_form.h"

namespace softscope {

/// SERV-CT experiment, StereoMIS sequence, D4D clip or recording, STIR sequence (up to 2025),
/// rectified sequence of Hamlyn's mirror, C3VD sequence. Otherwise as recogniseDataset().
std::optional<DatasetClip> recogniseShippedFolder(const std::filesystem::path& folder);

/// Time of an image SECONDS_NANOSECONDS.png; none for other names.
std::optional<double> stampOf(const std::filesystem::path& file);

/// Pairs of images of two cameras by nearest stamps, at most 5 ms apart, each used once.
struct StampedPairs {
  std::vector<std::filesystem::path> left, right;
  std::vector<double> times_s;  // of the left image, relative to the first
};
/// Throws InputError for a name without a stamp, or without any pair.
StampedPairs pairByStamp(const std::vector<std::filesystem::path>& left,
                         const std::vector<std::filesystem::path>& right);

}  // namespace softscope
