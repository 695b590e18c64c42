// src/io/sequences/sequence_reader.h: frames of a sequence, in order, read ahead on a thread of
// their own.
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

/// One frame, or why it couldn't be read.
struct FrameResult {
  int index = 0;          // position in the sequence, from 0
  Frame frame;            // empty where error isn't
  double time_s = 0;      // of the frame, also where it can't be read
  FrameNames names;       // also where it can't be read
  bool unpaired = false;  // nothing is wrong with it, but the other view has no image of its moment
  std::string error;      // one line; empty where all is well

  bool ok() const { return error.empty(); }
};

/// Opening reads the calibration and the first frame, and throws InputError on whatever is wrong
/// with them or with the sequence as a whole: missing or unequal numbers of images, sizes that
/// disagree with the calibration, an unreadable video, a mask of another size. A frame that turns
/// out bad later is a result with an error; the images after it follow, a video ends there.
/// At most options.read_ahead frames wait in memory. For one consumer thread.
class SequenceReader {
 public:
  SequenceReader(const SequencePaths& paths, const SequenceOptions& options);
  /// A folder as in findSequence().
  explicit SequenceReader(const std::filesystem::path& folder, const SequenceOptions& options = {});
  ~SequenceReader();
  SequenceReader(SequenceReader&&) noexcept;
  SequenceReader& operator=(SequenceReader&&) noexcept;

  /// With the image size filled in, and warnings about it.
  const StereoCalibration& calibration() const;

  /// Frames that next() will give, all in all.
  int frameCount() const;
  /// Frames of the sequence, whatever the range asked for.
  int totalCount() const;

  /// Nothing after the last one. Throws what isn't the input's fault (memory ran out).
  std::optional<FrameResult> next();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace softscope
