// src/io/images/image_walks.h: structure of each image format without decoding.
#pragma once

#include <string>
#include <string_view>

namespace softscope {

inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n";

struct PictureSize {
  long width_px = 0;
  long height_px = 0;
};

// All throw InputError for a truncated or damaged file; the sizes are unchecked.
PictureSize walkPng(std::string_view bytes, const std::string& name);
PictureSize walkJpeg(std::string_view bytes, const std::string& name);
PictureSize walkBmp(std::string_view bytes, const std::string& name);
PictureSize walkTiff(std::string_view bytes, const std::string& name);
PictureSize walkPnm(std::string_view bytes, const std::string& name);

}  // namespace softscope
