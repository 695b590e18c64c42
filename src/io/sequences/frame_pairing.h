// src/io/sequences/frame_pairing.h: pairing of files by frame number.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace softscope {

/// One view: path, files (empty for a video), number of images and their rate.
struct ViewFiles {
  std::filesystem::path path;
  std::vector<std::filesystem::path> files;
  int count = 0;
  double rate_hz = 0;  // of a video; 0: unknown
};

inline const std::vector<std::string_view> kMaskKinds = {".png", ".bmp",  ".jpg", ".jpeg",
                                                         ".tif", ".tiff", ".pgm"};
inline const std::vector<std::string_view> kDepthKinds = {".png", ".pfm", ".tif", ".tiff", ".npy"};

/// Throws InputError with the first image without a partner for
/// different counts, and for k-th files with different numbers. Different counts of files without
/// a number for each: names the first without number or with that of another file.
void requirePartners(const ViewFiles& view, const ViewFiles& other);

/// Mask or depth files of a folder (or a single file), one per image
/// of `view`, in its order. Throws InputError as requirePartners does.
std::vector<std::filesystem::path> partnersIn(const std::filesystem::path& path,
                                              const std::vector<std::string_view>& kinds,
                                              const ViewFiles& view);

}  // namespace softscope
