// src/io/images/image_writer.h: atomic writer of images.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/image.h"

namespace softscope {

// All throw OptionError if the file exists and
// `overwrite` is false, Error if it cannot be written.

void writePng(const std::filesystem::path& file, const GrayImage& image, bool overwrite = false);
void writePng(const std::filesystem::path& file, const ColourImage& image, bool overwrite = false);
void writePng(const std::filesystem::path& file, const Raster<std::uint16_t>& image,
              bool overwrite = false);

/// PNG with its physical size. Throws OptionError unless 1 to 100 000 dots per inch.
void writePng(const std::filesystem::path& file, const ColourImage& image, double dots_per_inch,
              bool overwrite);

/// `quality`: 1 (small) to 100 (good).
void writeJpeg(const std::filesystem::path& file, const ColourImage& image, int quality = 95,
               bool overwrite = false);

}  // namespace softscope
