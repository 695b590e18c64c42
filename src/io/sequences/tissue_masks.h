// src/io/sequences/tissue_masks.h: masks of StereoMIS, which show the tissue.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"

namespace softscope {

/// One per frame of `frames`, empty for a frame without one.
struct TissueMasks {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;  // frames without a mask, masks without a frame
};

/// Files NNNNNNl.png of a folder; others are ignored. A mask belongs to its frame, and to the
/// following one if that has none (half rate). Throws InputError for a folder without such a file,
/// and for two masks of one frame.
TissueMasks findTissueMasks(const std::filesystem::path& folder, int frames);

/// Pixels to be ignored: those where the file is 0, resized to the image by nearest neighbour.
/// Throws InputError as readMask() does.
Mask readTissueMask(const std::filesystem::path& file, int width_px, int height_px);

}  // namespace softscope
