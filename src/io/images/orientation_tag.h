// src/io/images/orientation_tag.h: orientation that a JPEG file states, which readers ignore.
#pragma once

#include <filesystem>
#include <string_view>

namespace softscope {

/// Exif orientation, 1 to 8; 1 (as stored) without a valid tag, for other formats and unreadable
/// files.
int orientationTag(const std::filesystem::path& file);
int parseOrientationTag(std::string_view bytes);

}  // namespace softscope
