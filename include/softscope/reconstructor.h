// include/softscope/reconstructor.h: stereo frames to a live, deforming model.
#pragma once

#include <memory>
#include <string>

#include "softscope/calibration.h"
#include "softscope/frame.h"
#include "softscope/options.h"
#include "softscope/run.h"

namespace softscope::api {

/// What became of one frame.
struct FrameReport {
  int frame = 0;
  std::string status;  // "started", "fused", ...: docs/formats.md, frames.csv
  std::string reason;  // why it was not fused; empty where it was
  bool fused = false;
  Pose world_from_left{};  // the last known one where this frame has none of its own
  double coverage = 0;     // share of the tissue with depth
  int matches = 0, points = 0;
  double elapsed_ms = 0;
};

/// Owns a model and follows it from frame to frame. For one thread at a time; works on many.
class Reconstructor {
 public:
  /// `backend`: auto, cpu or cuda. Throws OptionError and BackendError.
  explicit Reconstructor(const Calibration& calibration, const Options& options = {},
                         const std::string& backend = "auto");
  ~Reconstructor();
  Reconstructor(Reconstructor&&) noexcept;
  Reconstructor& operator=(Reconstructor&&) noexcept;

  /// Before the first frame: writes a run folder while frames are processed, a model of every
  /// `save_every`-th frame (0: only the last). Throws OptionError where the folder holds a run and
  /// `overwrite` is false.
  void recordTo(const std::string& folder, int save_every = 10, bool overwrite = false);

  /// A frame that is not good enough leaves the model as it was; the report says why. Throws
  /// InputError where an image does not fit the calibration.
  FrameReport process(const FrameView& frame);

  /// A copy of the model, in the light of the last fused image.
  Model model() const;

  /// Completes the run folder. Throws OptionError without recordTo(), InputError where not one
  /// frame was fused.
  Run finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope::api
