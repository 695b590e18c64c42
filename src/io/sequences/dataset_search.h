// src/io/sequences/dataset_search.h: clips of data sets in the folders below one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softscope {

struct FoundClip {
  std::filesystem::path folder;
  std::string form;  // as DatasetClip::form
};

/// Folders below `folder`, at most four levels down, that recogniseDataset() knows, by path. Looks
/// into at most 2000 folders, none of them by a link; a clip that lacks a part is left out.
std::vector<FoundClip> clipsBelow(const std::filesystem::path& folder);

}  // namespace softscope
