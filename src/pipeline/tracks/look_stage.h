// src/pipeline/tracks/look_stage.h: where a frame shows first looks.
#pragma once

#include <vector>

#include "features/first_look.h"
#include "pipeline/frame/frame_view.h"
#include "pipeline/tracks/track_pictures.h"

namespace softscope {

/// Same results on every back end.
class LookStage {
 public:
  virtual ~LookStage() = default;
  /// Whether find() takes the looks of the pictures.
  virtual bool takesPictures() const = 0;
  /// Points have other first looks than before.
  virtual void changed() {}
  /// `pictures`: of the frame.
  virtual std::vector<FoundLook> find(const std::vector<SoughtLook>& sought, const FrameView& frame,
                                      TrackPictures* pictures) = 0;
};

/// On the CPU.
class CpuLookStage final : public LookStage {
 public:
  bool takesPictures() const override { return true; }
  std::vector<FoundLook> find(const std::vector<SoughtLook>& sought, const FrameView& /*frame*/,
                              TrackPictures* pictures) override {
    return findLooks(sought, pictures->looks());
  }
};

}  // namespace softscope
