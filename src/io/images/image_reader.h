// src/io/images/image_reader.h: reader of images: png, jpg, bmp, tif, pgm and ppm.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/image.h"

namespace softscope {

// Each reads a file, or its bytes from memory with `name` for errors. All throw
// InputError for a missing, empty, truncated or damaged file, another format or
// an implausible size. 16-bit images are scaled to 8 bits; an orientation tag
// is ignored, because a calibration refers to the stored pixels.

/// Grey images get three equal channels; transparency is dropped.
ColourImage readColourImage(const std::filesystem::path& file);
ColourImage parseColourImage(std::string_view bytes, const std::string& name);

/// Colour is converted by toGray().
GrayImage readGrayImage(const std::filesystem::path& file);
GrayImage parseGrayImage(std::string_view bytes, const std::string& name);

/// 255 if any channel is non-zero, else 0; transparency is ignored.
/// For JPEG, whose zeros are inexact, the threshold is 128.
Mask readMask(const std::filesystem::path& file);
Mask parseMask(std::string_view bytes, const std::string& name);

}  // namespace softscope
