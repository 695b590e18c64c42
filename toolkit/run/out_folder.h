// toolkit/run/out_folder.h: folders of results, apart from their inputs.
#pragma once

#include <filesystem>

#include "io/sequences/sequence_paths.h"

namespace softscope {

/// With its parents. Throws InputError.
void makeFolder(const std::filesystem::path& out);

/// Throws OptionError if `out` is, or is inside, a folder of images,
/// masks or depth of the sequence: results would be read as frames.
void requireApart(const std::filesystem::path& out, const SequencePaths& sequence);

/// Also throws if `out` is the folder of the sequence itself, whose files would be replaced.
void requireOutside(const std::filesystem::path& out, const SequencePaths& sequence);

}  // namespace softscope
