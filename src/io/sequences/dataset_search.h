// src/io/sequences/dataset_search.h: search of clips of data sets in subfolders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope {

struct FoundClip {
  std::filesystem::path folder;
  std::string form;  // as DatasetClip::form
};

/// Subfolders of `folder`, at most four levels deep, known to recogniseDataset(), sorted by
/// path. Searches at most 2000 folders without following links; incomplete clips are omitted.
std::vector<FoundClip> clipsBelow(const std::filesystem::path& folder);

}  // namespace softscope
