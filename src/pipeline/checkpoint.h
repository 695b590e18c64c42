// src/pipeline/checkpoint.h: serialisation of a run's state, for resuming.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/reconstructor.h"

namespace softscope {

template <class State>
struct CheckpointOf {
  std::string settings;  // a digest of everything that decides the result
  int next_frame = 0;    // of the sequence
  State state;
};
using Checkpoint = CheckpointOf<ReconstructionState>;
/// To write, of a Reconstructor's state().
using CheckpointView = CheckpointOf<ReconstructionStateView>;

/// Little-endian, with a magic word, a version and a checksum: a file that was cut or altered is
/// not read. For the machine that wrote it; no format to keep data in.
std::string checkpointBytes(const CheckpointView& checkpoint);

/// Throws InputError, naming `name`, for bytes that are no whole checkpoint of this version.
Checkpoint parseCheckpoint(std::string_view bytes, const std::string& name);

}  // namespace softscope
