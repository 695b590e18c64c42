// src/io/images/quiet_libraries.h: suppression of messages of image libraries.
#pragma once

#include <cstdio>

namespace softscope {

/// Redirects the C stream `stderr`, to which OpenCV, FFmpeg, libpng, libtiff
/// and other C libraries print messages about unreadable files. std::cerr
/// and ownErrors() are unchanged. Must be called before the first file and
/// the first thread. OPENCV_LOG_LEVEL and OPENCV_FFMPEG_LOGLEVEL of the
/// environment are respected; the first also disables the redirection.
void quietLibraries();

/// The original `stderr` before quietLibraries().
std::FILE* ownErrors();

}  // namespace softscope
