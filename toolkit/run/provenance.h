// toolkit/run/provenance.h: check that a run belongs to a sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolkit/run/run_reader.h"

namespace softscope {

/// Compares cameras and images with run.json in the folder of a run; passes without one. Returns
/// warnings about another focal length or baseline, or other images, which may
/// be intended. Throws InputError for a damaged run.json or another image size.
std::vector<std::string> checkOrigin(const std::filesystem::path& run, const SequenceTruth& truth);

}  // namespace softscope
