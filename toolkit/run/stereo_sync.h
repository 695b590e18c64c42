// toolkit/run/stereo_sync.h: time offset between the views of a clip.
#pragma once

#include <string>

#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"

namespace softscope {

/// Where sequence.right_offset is auto and there are two views to compare, finds it from the frames
/// that follow the first one asked for, whatever the range's end and step are, and writes it into
/// `options`. Returns a warning where it isn't 0, else
/// nothing. What can't be read or matched changes nothing: the reconstruction reports it. Throws
/// InputError as the reader does.
std::string settleRightOffset(const SequencePaths& paths, SequenceOptions& options,
                              int disparity_max_px);

}  // namespace softscope
