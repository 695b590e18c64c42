// toolkit/run/provenance.h: whether a run was made from the sequence that it is judged by.
#pragma once

#include <string>
#include <vector>

#include "toolkit/run/run_reader.h"

namespace softscope {

/// By what run.json says of the cameras and pictures; a run without one passes. Returns a line for
/// what may be meant that way: another focal length or baseline, other pictures. Throws InputError
/// where run.json is broken or its pictures have another size.
std::vector<std::string> checkOrigin(const JudgedRun& run, const SequenceTruth& truth);

}  // namespace softscope
