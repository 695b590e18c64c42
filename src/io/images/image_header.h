// src/io/images/image_header.h: size and completeness of an image file, checked before anything is
// decoded.
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

/// Recognises the form by content and walks its structure to the end: PNG with check sums, JPEG
/// to its end marker, BMP and binary PGM/PPM by length, TIFF to its first directory.
/// Throws InputError on another form, a truncated or damaged file, and absurd sizes.
ImageHeader inspectImage(std::string_view bytes, const std::string& name);

}  // namespace softscope
