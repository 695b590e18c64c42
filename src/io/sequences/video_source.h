// src/io/sequences/video_source.h: sequential video reader.
#pragma once

#include <filesystem>
#include <memory>

#include "io/sequences/picture_source.h"

namespace softscope {

/// Frames are decoded in order, because seeking is inexact in most codecs.
/// Throws InputError for a video that cannot be opened or has no frame.
std::unique_ptr<PictureSource> openVideo(const std::filesystem::path& file);

}  // namespace softscope
