// toolkit/run/stereo_sync.h: time offset between the views of a clip.
#pragma once

#include <string>

#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"
#include "pipeline/options/reconstruction_options.h"

namespace softscope {

/// For sequence.right_offset=auto and two views, unless depth comes from
/// the files of the sequence: estimates the offset from the frames after the first requested one,
/// independent of end and step of the range, and writes it into `options`. Returns a warning if it
/// is not 0. Unreadable or unmatched images change nothing: the reconstruction reports them. Throws
/// InputError as the reader does.
std::string estimateRightOffset(const SequencePaths& paths, const FrameDepthOptions& depth,
                                SequenceOptions& options);

}  // namespace softscope
