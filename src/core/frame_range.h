// src/core/frame_range.h: which frames of a sequence.
#pragma once

namespace softscope {

/// Frames begin, begin + step, …, below end.
struct FrameRange {
  int begin = 0;
  int end = -1;  // -1 = to the last
  int step = 1;

  /// How many frames; `end` must be known.
  int count() const { return (end - begin + step - 1) / step; }
};

}  // namespace softscope
