// toolkit/run/stereo_sync.h: pairs the pictures of a clip whose views are some pictures apart.
#pragma once

#include <string>

#include "io/sequences/sequence_options.h"
#include "io/sequences/sequence_paths.h"

namespace softscope {

/// Where sequence.right_offset is auto and there are two views to compare, finds it from the frames
/// that follow the first one asked for, whatever the range's end and step are, and writes it into
/// `options`. Returns a warning where it isn't 0, else
/// nothing. What can't be read or matched changes nothing: who reconstructs will report it. Throws
/// InputError as the reader does.
std::string settleRightOffset(const SequencePaths& paths, SequenceOptions& options,
                              int disparity_max_px);

}  // namespace softscope
