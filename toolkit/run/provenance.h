// toolkit/run/provenance.h: check that a run belongs to a sequence.
#pragma once

#include <string>
#include <vector>

#include "toolkit/run/run_reader.h"

namespace softscope {

/// Compares cameras and images with run.json; passes without one. Returns
/// warnings about another focal length or baseline, or other images, which may
/// be intended. Throws InputError for a damaged run.json or another image size.
std::vector<std::string> checkOrigin(const JudgedRun& run, const SequenceTruth& truth);

}  // namespace softscope
