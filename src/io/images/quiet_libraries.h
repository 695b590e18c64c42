// src/io/images/quiet_libraries.h: suppression of messages that image libraries print.
#pragma once

#include <cstdio>

namespace softscope {

/// From here on OpenCV, FFmpeg, libpng, libtiff and other C libraries print nothing about files
/// that they can't read: the C stream `stderr`, which they print to, leads nowhere. std::cerr and
/// ownErrors() still lead to the terminal. To be called before the first file and the first thread.
/// OPENCV_LOG_LEVEL and OPENCV_FFMPEG_LOGLEVEL, where the environment sets them, stay in force, and
/// the first of them leaves `stderr` as it is.
void quietLibraries();

/// The stream that `stderr` was before quietLibraries().
std::FILE* ownErrors();

}  // namespace softscope
