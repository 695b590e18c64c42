// src/io/images/image_header.h: size and completeness
// of an image file, checked before decoding.
#pragma once

#include <string>
#include <string_view>

namespace softscope {

enum class ImageForm { kPng, kJpeg, kBmp, kTiff, kPnm };

struct ImageHeader {
  ImageForm form = ImageForm::kPng;
  int width_px = 0;
  int height_px = 0;
};

/// Detects the format from the content and parses its structure to the end: PNG with checksums,
/// JPEG to its end marker, BMP and binary PGM/PPM by length, TIFF to its first directory.
/// Throws InputError for another format, a truncated or damaged file, and implausible sizes.
ImageHeader inspectImage(std::string_view bytes, const std::string& name);

}  // namespace softscope
