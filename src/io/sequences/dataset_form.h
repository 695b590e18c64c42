// src/io/sequences/dataset_form.h: detection of the public data set whose layout a folder has.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/sequences/sequence_paths.h"

namespace softscope {

/// A folder that is no sequence folder of docs/formats.md, but one clip of a known data set.
struct DatasetClip {
  std::string form;                          // "STIR 2026", "SurgT", "SCARED", …
  SequencePaths paths;                       // with the layout of both views in one image
  std::vector<std::filesystem::path> truth;  // files of ground truth that are there
};

/// By the names of its files alone; nothing where the folder is none. Throws InputError where a
/// part is missing that the form can't do without (the video, the calibration).
std::optional<DatasetClip> recogniseDataset(const std::filesystem::path& folder);

}  // namespace softscope
