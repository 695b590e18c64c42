// toolkit/run/provenance.h: check that a run was made from the given sequence.
#pragma once

#include <string>
#include <vector>

#include "toolkit/run/run_reader.h"

namespace softscope {

/// By what run.json says of the cameras and images; a run without one passes. Returns a line for
/// what may be meant that way: another focal length or baseline, other images. Throws InputError
/// where run.json is broken or its images have another size.
std::vector<std::string> checkOrigin(const JudgedRun& run, const SequenceTruth& truth);

}  // namespace softscope
