// src/pipeline/track_pictures.h: what tracked points need of a frame, found in parallel to stages
// that do not need it.
#pragma once

#include <future>
#include <memory>

#include "pipeline/first_look.h"
#include "pipeline/track_sight.h"

namespace softscope {

/// One frame at a time. Same results with prepare() and without.
class TrackPictures {
 public:
  struct Pictures {
    LookPicture looks;
    Raster<float> relief_px;
  };

  /// Both must live; the frame may change after end() only.
  TrackPictures(const FrameView* frame, const RectifiedRig* rig) : frame_(frame), rig_(rig) {}

  /// Begins to make the pictures of the frame, which are otherwise made when they are needed.
  void prepare();
  const Pictures& pictures();
  void end();

 private:
  Pictures make() const;

  const FrameView* frame_;
  const RectifiedRig* rig_;
  std::unique_ptr<Pictures> pictures_;
  std::future<Pictures> making_;  // its thread ends before the members above are destroyed
};

}  // namespace softscope
