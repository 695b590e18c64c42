// apps/right_offset.h: pairs the pictures of a clip whose views are some pictures apart.
#pragma once

#include "io/sequence_options.h"
#include "io/sequence_paths.h"

namespace softscope {

/// Where sequence.right_offset is auto and there are two views to compare, finds it from the first
/// frames asked for, writes it into `options`, and says so where it isn't 0. What can't be read or
/// matched changes nothing: who reconstructs will report it. Throws InputError as the reader does.
void settleRightOffset(const SequencePaths& paths, SequenceOptions& options, int disparity_max_px);

}  // namespace softscope
