// src/fusion/frame_uploader.h: frames on another device before the stages ask for them.
#pragma once

#include "core/image.h"
#include "fusion/observation.h"

namespace softscope {

class FrameUploader {
 public:
  virtual ~FrameUploader() = default;
  /// Copies a frame and its image as it is matched, while the stages work on the frame before, on
  /// any thread. The pose doesn't matter. The rasters are then used until the next frame is, and
  /// must stay where they are in memory.
  virtual void upload(const Observation& frame, const Raster<PixelState>& states,
                      const GrayImage& gray, const Mask& ignore) = 0;
  /// The stages work on the frame with that depth now. One that was not uploaded last is copied by
  /// each stage that needs it.
  virtual void use(const DepthMap& depth) = 0;
};

}  // namespace softscope
