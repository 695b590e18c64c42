// src/io/quiet_libraries.h: what goes wrong with a file is told by our errors alone.
#pragma once

namespace softscope {

/// From here on OpenCV and FFmpeg print nothing about files that they can't read. To be called
/// before the first file and the first thread. OPENCV_LOG_LEVEL and OPENCV_FFMPEG_LOGLEVEL, where
/// the environment sets them, stay in force.
void quietLibraries();

}  // namespace softscope
