// src/io/sequences/shipped_folders.h: data sets that ship folders of images or a film with tables
// beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "io/sequences/dataset_form.h"

namespace softscope {

/// SERV-CT's experiment, StereoMIS' sequence, D4D's clip or recording, STIR's sequence (to 2025),
/// a rectified sequence of Hamlyn's mirror, C3VD's sequence. Otherwise as recogniseDataset().
std::optional<DatasetClip> recogniseShippedFolder(const std::filesystem::path& folder);

/// Moment of an image SECONDS_NANOSECONDS.png; nothing where the name has another form.
std::optional<double> stampOf(const std::filesystem::path& file);

/// Images of two cameras of one moment: nearest stamps, at most 5 ms apart, each used once.
struct StampedPairs {
  std::vector<std::filesystem::path> left, right;
  std::vector<double> times_s;  // of the left one, from the first
};
/// Throws InputError where a name holds no stamp, or no two belong together.
StampedPairs pairByStamp(const std::vector<std::filesystem::path>& left,
                         const std::vector<std::filesystem::path>& right);

}  // namespace softscope
