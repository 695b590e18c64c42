// src/io/images/image_reader.h: images from disk: png, jpg, bmp, tif, pgm and ppm.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/image.h"

namespace softscope {

// Each reads a file, or its bytes from memory, where `name` is what errors call it. All throw
// InputError on a file that is missing, empty, truncated, damaged, of another form or of an absurd
// size. 16-bit images are scaled to 8 bits; an orientation tag is ignored, because a calibration
// refers to the pixels as they are stored.

/// Grey images get three equal channels; transparency is dropped.
ColourImage readColourImage(const std::filesystem::path& file);
ColourImage parseColourImage(std::string_view bytes, const std::string& name);

/// Colour becomes luma, by toGray().
GrayImage readGrayImage(const std::filesystem::path& file);
GrayImage parseGrayImage(std::string_view bytes, const std::string& name);

/// 255 where any channel is non-zero, else 0; transparency doesn't count. Of a JPEG, whose zeros
/// are only nearly so, values from 128 on count.
Mask readMask(const std::filesystem::path& file);
Mask parseMask(std::string_view bytes, const std::string& name);

}  // namespace softscope
