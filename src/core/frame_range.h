// src/core/frame_range.h: range of frame numbers with a step.
#pragma once

namespace softscope {

/// Frames begin, begin + step, …, below end, without held-out frames.
struct FrameRange {
  int begin = 0;
  int end = -1;  // -1 = to the last frame
  int step = 1;
  int hold_out_every = 0;  // frames 1, n + 1, 2n + 1, … of the sequence are held out; 0: none

  bool holdsOut(int frame) const { return hold_out_every > 0 && frame % hold_out_every == 1; }
  /// Number of frames; `end` must be known.
  int count() const {
    int frames = 0;
    for (int frame = begin; frame < end; frame += step) frames += !holdsOut(frame);
    return frames;
  }
};

}  // namespace softscope
