// include/softscope/reconstructor.h: deforming model from stereo frames.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "softscope/calibration.h"
#include "softscope/frame.h"
#include "softscope/options.h"
#include "softscope/run.h"
#include "softscope/sequence.h"

namespace softscope::api {

/// Result of one frame.
struct FrameReport {
  int frame = 0;       // index in the sequence; of images without one: last frame + 1
  std::string status;  // "started", "fused", ...: docs/formats.md, frames.csv
  std::string reason;  // reason if it was not fused; else empty
  bool fused = false;
  Pose world_from_left{};  // last known pose if this frame has none
  /// In whose world the pose is: 0 for the first model, another number for that of another place.
  int map = 0;
  /// Map that is part of `map` from this frame on, and its motion into it: docs/matching.md. -1:
  /// none.
  int joined_map = -1;
  Pose world_from_joined{};
  double coverage = 0;  // share of the tissue with depth
  /// 0 to 1: docs/fusion.md, F27. NaN if neither the first
  /// fused frame nor compared with the model.
  double confidence = std::numeric_limits<double>::quiet_NaN();
  int matches = 0, points = 0;
  double elapsed_ms = 0;
};

/// Owns a model and updates it per frame. For one thread at a time; parallel inside.
class Reconstructor {
 public:
  /// `backend`: auto, cpu or cuda. Throws OptionError and BackendError.
  explicit Reconstructor(const Calibration& calibration, const Options& options = {},
                         const std::string& backend = "auto");
  ~Reconstructor();
  Reconstructor(Reconstructor&&) noexcept;
  Reconstructor& operator=(Reconstructor&&) noexcept;

  /// Before the first frame: writes a run folder during processing, with
  /// the model of every `save_every`-th frame (0: last only); all files are updated every 100
  /// frames. They are written on a thread of their own: finish() waits. Throws OptionError if the
  /// folder contains a run and `overwrite` is false.
  void recordTo(const std::string& folder, int save_every = 10, bool overwrite = false);

  /// Next frame of `sequence`, from its first on in the time of `softscope reconstruct`: the depth
  /// of the following frames is measured meanwhile. None after the last frame. A rejected or
  /// unreadable frame leaves the model unchanged; the report contains the reason. Other images
  /// may follow after any frame. Throws InputError for images that do not fit the calibration or
  /// were deleted; OptionError if the folder of the run is in the sequence, if the run has frames
  /// of other files, or a frame of this index or a later one, or if the options of the
  /// reconstructor have a value for the sequence that those of `sequence` do not have.
  std::optional<FrameReport> process(Sequence& sequence);
  /// The same for images without a Sequence. Throws InputError for
  /// an image that does not fit the calibration.
  FrameReport process(const FrameView& frame);

  /// Copy of the model, in the illumination of the last fused image.
  Model model() const;

  /// Completes the run folder. Throws OptionError without
  /// recordTo(), InputError if no frame was fused.
  Run finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope::api
