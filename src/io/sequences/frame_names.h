// src/io/sequences/frame_names.h: names and numbers of the files of a frame.
#pragma once

#include <string>

namespace softscope {

/// The files of a frame, as the user names them.
struct FrameNames {
  long long number = 0;     // in the left file's name; the frame's index where that has none
  std::string left, right;  // file names; of a video or of one file with both views, that file's
};

}  // namespace softscope
