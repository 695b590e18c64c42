// src/io/files/file_hash.h: SHA-256 of files, folders and bytes.
#pragma once

#include <filesystem>
#include <string>

namespace softscope {

/// SHA-256 in hexadecimal. Of a file its content; of a folder the names and contents of the files
/// directly in it, in natural order. Throws InputError where it can't be read.
std::string sha256Of(const std::filesystem::path& path);

/// Of bytes in memory.
std::string sha256OfBytes(const std::string& bytes);

}  // namespace softscope
