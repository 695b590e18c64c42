// src/io/images/image_writer.h: images to disk, written atomically.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/image.h"

namespace softscope {

// All throw OptionError where the file exists and `overwrite` is false, Error where it can't be
// written.

void writePng(const std::filesystem::path& file, const GrayImage& image, bool overwrite = false);
void writePng(const std::filesystem::path& file, const ColourImage& image, bool overwrite = false);
void writePng(const std::filesystem::path& file, const Raster<std::uint16_t>& image,
              bool overwrite = false);

/// A PNG that says how large it is on paper. Throws OptionError unless 1 to 100 000 dots an inch.
void writePng(const std::filesystem::path& file, const ColourImage& image, double dots_per_inch,
              bool overwrite);

/// `quality`: 1 (small) to 100 (good).
void writeJpeg(const std::filesystem::path& file, const ColourImage& image, int quality = 95,
               bool overwrite = false);

}  // namespace softscope
