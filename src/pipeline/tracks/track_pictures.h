// src/pipeline/tracks/track_pictures.h: what tracked points need of a frame, found in parallel to
// stages that do not need it.
#pragma once

#include <future>
#include <optional>

#include "features/first_look.h"
#include "pipeline/frame/frame_ahead.h"

namespace softscope {

/// One frame at a time. Same results with prepare() and without.
class TrackPictures {
 public:
  /// Both must live; the frame, the last that was measured, may change after end() only.
  TrackPictures(const FrameView* frame, const FrameAhead* frames)
      : frame_(frame), frames_(frames) {}

  /// Begins to make what is otherwise made when it is needed; the looks only if they are.
  void prepare(bool with_looks);
  const LookPicture& looks();
  const Raster<float>& reliefPx();
  void end();

 private:
  LookPicture makeLooks() const;
  Raster<float> makeRelief() const;

  const FrameView* frame_;
  const FrameAhead* frames_;
  std::optional<LookPicture> looks_;
  std::optional<Raster<float>> relief_px_;
  // Their threads end before the members above are destroyed.
  std::future<LookPicture> making_looks_;
  std::future<Raster<float>> making_relief_;
};

}  // namespace softscope
