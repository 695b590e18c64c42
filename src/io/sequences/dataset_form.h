// src/io/sequences/dataset_form.h: detection of the data set of a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/sequences/sequence_paths.h"

namespace softscope {

/// Clip of a known data set in its original layout (not a sequence folder of docs/formats.md).
struct DatasetClip {
  std::string form;                          // "STIR 2026", "SurgT", "SCARED", …
  SequencePaths paths;                       // with the packing of both views in one image
  std::vector<std::filesystem::path> truth;  // existing files of ground truth
  std::string benchmark;                     // name of the benchmark that reads them; empty: none
};

/// By file names only; none for other folders. Throws InputError
/// if a required part is missing (video, calibration).
std::optional<DatasetClip> recogniseDataset(const std::filesystem::path& folder);

}  // namespace softscope
