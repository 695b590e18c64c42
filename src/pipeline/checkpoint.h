// src/pipeline/checkpoint.h: serialised state of a run, for resuming.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/reconstructor.h"

namespace softscope {

template <class State>
struct CheckpointOf {
  std::string settings;  // hash of all inputs and settings that determine the result
  int next_frame = 0;    // of the sequence
  State state;
};
using Checkpoint = CheckpointOf<ReconstructionState>;
/// For writing, from state() of a Reconstructor.
using CheckpointView = CheckpointOf<ReconstructionStateView>;

/// Little-endian, with a magic word, a version and a checksum: truncated or modified
/// data are rejected. Valid on the machine that wrote it; not an archive format.
std::string checkpointBytes(const CheckpointView& checkpoint);

/// Throws InputError with `name` unless the bytes are a complete checkpoint of this version.
Checkpoint parseCheckpoint(std::string_view bytes, const std::string& name);

}  // namespace softscope
