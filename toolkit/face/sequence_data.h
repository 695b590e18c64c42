// toolkit/face/sequence_data.h: content of a Sequence of the public interface.
#pragma once

#include "io/sequences/frame_window.h"
#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"
#include "io/sequences/sequence_reader.h"
#include "softscope/sequence.h"
#include "toolkit/run/stereo_sync.h"

namespace softscope::api {

struct Sequence::Impl {
  /// Opens as `softscope reconstruct` does. Throws InputError.
  Impl(SequencePaths opened, const Options& given);

  SequencePaths paths;
  Options chosen;
  ViewRelation views;
  SequenceOptions options;  // as used: with the estimated offset
  SequenceReader reader;
  FrameWindow frames;
};

}  // namespace softscope::api
