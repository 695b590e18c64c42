// src/io/files/folder.h: files of a folder in natural numeric order.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Type of the path's target; false, never a throw, if unknown: the reader reports it.
bool isThere(const std::filesystem::path& path);
bool isFile(const std::filesystem::path& path);
bool isFolder(const std::filesystem::path& path);

/// frame2 before frame10; without numbers, by bytes.
bool naturallyBefore(std::string_view a, std::string_view b);

/// Files whose lower-case extension is one of `extensions` (with the dot), in natural order; hidden
/// files are left out, folders are not entered. Throws InputError where the folder is missing, or
/// a symbolic link in it leads nowhere or back to itself.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder,
                                           const std::vector<std::string_view>& extensions);

/// Those of `names` that lie in the folder, as paths, in their order.
std::vector<std::filesystem::path> existingIn(const std::filesystem::path& folder,
                                              const std::vector<std::string>& names);

/// Throws the InputError of filesIn() where `folder` is none.
void requireFolder(const std::filesystem::path& folder);

/// The name of a frame's file: 38 and ".ply" make 000038.ply.
std::string numberedName(int frame, const std::string& end);

/// The last run of digits in the name without extension: frame_07b.png has 7.
std::optional<long long> frameNumber(const std::filesystem::path& file);

}  // namespace softscope
