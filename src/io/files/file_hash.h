// src/io/files/file_hash.h: SHA-256 of files, folders and bytes.
#pragma once

#include <filesystem>
#include <string>

namespace softscope {

/// SHA-256 in hexadecimal. For a file its content; for a folder the names and contents of
/// its files (not of subfolders) in natural order. Throws InputError for unreadable files.
std::string sha256Of(const std::filesystem::path& path);

/// For bytes in memory.
std::string sha256OfBytes(const std::string& bytes);

}  // namespace softscope
