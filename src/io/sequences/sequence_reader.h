// src/io/sequences/sequence_reader.h: sequential
// reader of frames with a read-ahead thread.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/frame.h"
#include "core/stereo_rig.h"
#include "io/sequences/frame_names.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"

namespace softscope {

/// Frame, or the reason for a failure.
struct FrameResult {
  int index = 0;           // position in the sequence, from 0
  Frame frame;             // empty after an error
  double time_s = 0;       // of the frame, also if it is unreadable
  FrameNames names;        // also if the frame is unreadable
  bool unpaired = false;   // no error: the other view has no image of this time
  bool bad_views = false;  // and unpaired: a view stands still, or both are equal
  bool repeats = false;    // both images are those of the frame before
  std::string error;       // one line; empty without an error

  bool ok() const { return error.empty(); }
};

/// The constructor reads the calibration and the first frame, and throws InputError for
/// their faults and those of the whole sequence: missing images, different counts, sizes
/// that contradict the calibration, an unreadable video, a mask of another size. A later
/// unreadable frame is a result with an error; the following images are read, a video
/// ends there. So is a pair with a fault of io/sequences/view_progress.h, compared with the frame
/// before it in the range, of the first one with the frame a step before; not with depth files. At
/// most options.read_ahead frames are queued. For one consumer thread.
class SequenceReader {
 public:
  SequenceReader(const SequencePaths& paths, const SequenceOptions& options);
  /// Folder as in findSequence().
  explicit SequenceReader(const std::filesystem::path& folder, const SequenceOptions& options = {});
  ~SequenceReader();
  SequenceReader(SequenceReader&&) noexcept;
  SequenceReader& operator=(SequenceReader&&) noexcept;

  /// With the image size, and warnings about it.
  const StereoCalibration& calibration() const;
  /// Sets those of the calibration, after they are measured.
  void expectRows(const RowPlane& rows);

  /// Number of frames of the range.
  int frameCount() const;
  /// Number of frames of the sequence.
  int totalCount() const;

  /// None after the last frame. Throws failures other than input errors (out of memory).
  std::optional<FrameResult> next();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope
