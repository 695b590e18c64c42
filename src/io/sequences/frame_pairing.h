// src/io/sequences/frame_pairing.h: pairing of files by frame number.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace softscope {

/// One view: its path, its files (none of a video) and how many images it has.
struct ViewFiles {
  std::filesystem::path path;
  std::vector<std::filesystem::path> files;
  int count = 0;
};

inline const std::vector<std::string_view> kMaskKinds = {".png", ".bmp",  ".jpg", ".jpeg",
                                                         ".tif", ".tiff", ".pgm"};
inline const std::vector<std::string_view> kDepthKinds = {".png", ".pfm", ".tif", ".tiff", ".npy"};

/// Throws InputError where the counts differ, naming the first image without a partner, or where
/// the k-th files of both carry different numbers.
void requirePartners(const ViewFiles& view, const ViewFiles& other);

/// The mask or depth files of a folder (or the one file), one for every image of `view`, in its
/// order. Throws InputError as requirePartners does.
std::vector<std::filesystem::path> partnersIn(const std::filesystem::path& path,
                                              const std::vector<std::string_view>& kinds,
                                              const ViewFiles& view);

}  // namespace softscope
