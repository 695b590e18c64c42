// toolkit/run/out_folder.h: results apart from what they are made of.
#pragma once

#include <filesystem>

#include "io/sequences/sequence_paths.h"

namespace softscope {

/// Throws OptionError where `out` is, or lies in, a folder of images, masks or depth of the
/// sequence: results among them would be read as its frames.
void requireApart(const std::filesystem::path& out, const SequencePaths& sequence);

/// The same, and where `out` is the sequence's own folder, whose files would be replaced.
void requireOutside(const std::filesystem::path& out, const SequencePaths& sequence);

}  // namespace softscope
