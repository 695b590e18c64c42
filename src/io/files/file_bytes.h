// src/io/files/file_bytes.h: a whole file in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace softscope {

/// Reads a regular file. Throws InputError where it is missing, empty, a folder, a device, a
/// symbolic link that leads to itself, unreadable, or larger than `limit_bytes`.
std::string readBytes(const std::filesystem::path& file,
                      std::uintmax_t limit_bytes = std::uintmax_t{1} << 30);

/// A calibration is a few kilobytes; what is larger is another file.
inline constexpr std::uintmax_t kCalibrationLimitBytes = std::uintmax_t{4} << 20;

/// The limit for files that hold text alone.
inline constexpr std::uintmax_t kTextLimitBytes = std::uintmax_t{64} << 20;

/// Throws the InputError of readBytes where `file` isn't a regular file with content.
void requireFile(const std::filesystem::path& file);

}  // namespace softscope
