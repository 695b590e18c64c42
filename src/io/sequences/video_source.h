// src/io/sequences/video_source.h: a video, frame after frame.
#pragma once

#include <filesystem>
#include <memory>

#include "io/sequences/picture_source.h"

namespace softscope {

/// Frames are reached by decoding all before them, because seeking isn't exact in most codecs.
/// Throws InputError where the video can't be opened or holds no frame.
std::unique_ptr<PictureSource> openVideo(const std::filesystem::path& file);

}  // namespace softscope
