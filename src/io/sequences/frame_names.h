// src/io/sequences/frame_names.h: names and numbers of the files of a frame.
#pragma once

#include <string>

namespace softscope {

/// Files of a frame as named by the user.
struct FrameNames {
  long long number = 0;     // in the name of the left file; index of the frame without a number
  std::string left, right;  // file names; for a video or packed views the name of that file
};

}  // namespace softscope
