// src/io/files/folder.h: files of a folder in natural order.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// File type of the target; false, without an exception, if unknown: the reader reports it.
bool isThere(const std::filesystem::path& path);
bool isFile(const std::filesystem::path& path);
bool isFolder(const std::filesystem::path& path);

/// frame2 before frame10; by bytes without numbers.
bool naturallyBefore(std::string_view a, std::string_view b);

/// Files whose lower-case extension is one of `extensions` (with the dot),
/// in natural order, without hidden files and subfolders. Throws InputError
/// for a missing folder, or a dangling or cyclic symbolic link in it.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder,
                                           const std::vector<std::string_view>& extensions);

/// Those of `names` that exist in the folder, as paths, in their order.
std::vector<std::filesystem::path> existingIn(const std::filesystem::path& folder,
                                              const std::vector<std::string>& names);

/// Throws the InputError of filesIn() for a missing folder.
void requireFolder(const std::filesystem::path& folder);

/// File name of a frame: 38 and ".ply" give 000038.ply.
std::string numberedName(int frame, const std::string& end);

/// Last run of digits in the name without extension: frame_07b.png has 7.
std::optional<long long> frameNumber(const std::filesystem::path& file);

}  // namespace softscope
