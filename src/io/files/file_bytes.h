// src/io/files/file_bytes.h: reading of whole files into memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace softscope {

/// Reads a regular file. Throws InputError for a missing, empty or unreadable file,
/// a folder, a device, a cyclic symbolic link, or a file larger than `limit_bytes`.
std::string readBytes(const std::filesystem::path& file,
                      std::uintmax_t limit_bytes = std::uintmax_t{1} << 30);

/// The same for a text, without the byte-order mark of UTF-8. Throws InputError for UTF-16.
std::string readText(const std::filesystem::path& file,
                     std::uintmax_t limit_bytes = std::uintmax_t{1} << 30);

/// A calibration has a few kilobytes.
inline constexpr std::uintmax_t kCalibrationLimitBytes = std::uintmax_t{4} << 20;

/// Limit for text files.
inline constexpr std::uintmax_t kTextLimitBytes = std::uintmax_t{64} << 20;

/// Throws the InputError of readBytes unless `file` is a regular file with content.
void requireFile(const std::filesystem::path& file);

}  // namespace softscope
