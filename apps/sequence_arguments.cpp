// apps/sequence_arguments.cpp: what is a folder has its own calibration.
#include "apps/sequence_arguments.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"

namespace softscope {

namespace {

namespace fs = std::filesystem;

/// Without links and dots; of what isn't there yet, as far as it is.
fs::path settled(const fs::path& path) {
  std::error_code problem;
  const fs::path found = fs::weakly_canonical(fs::absolute(path), problem);
  const fs::path plain = problem ? path.lexically_normal() : found;
  return plain.has_filename() ? plain : plain.parent_path();
}

bool liesIn(const fs::path& path, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

[[noreturn]] void refuseInput(const std::string& out, const char* what) {
  throw OptionError("--out " + out + ": " + what + "; choose a folder of its own for the results");
}

}  // namespace

void requireApart(const std::string& out, const SequencePaths& sequence) {
  std::error_code ignored;
  for (const fs::path& part :
       {sequence.left, sequence.right, sequence.stereo, sequence.mask, sequence.depth})
    if (!part.empty() && fs::is_directory(part, ignored) && liesIn(settled(out), settled(part)))
      refuseInput(out, "is, or lies in, a folder of the sequence, whose frames would be mixed up");
}

void requireOutside(const std::string& out, const SequencePaths& sequence) {
  requireApart(out, sequence);
  const fs::path& view = sequence.left.empty() ? sequence.stereo : sequence.left;
  if (settled(out) == settled(view).parent_path())
    refuseInput(out, "is the folder of the sequence, whose own files would be replaced");
}

void SequenceArguments::declareOptions(ArgumentList& arguments) {
  arguments.option("--calibration", "FILE", calibration,
                   "calibration; a sequence folder has its own");
  arguments.option("--mask", "PATH", mask, "picture or folder; non-zero pixels are ignored");
  arguments.option("--frames", "A:B", frames, "frames A up to, not with, B");
}

SequencePaths SequenceArguments::paths(const std::string& command) const {
  std::error_code ignored;  // what isn't there, or a link to itself, is the reader's to report
  const bool is_file = std::filesystem::is_regular_file(left, ignored);
  const bool is_folder = std::filesystem::is_directory(left, ignored);
  SequencePaths paths;
  if (right.empty() && (is_folder || (calibration.empty() && !is_file))) {
    paths = findSequence(left);
  } else if (calibration.empty()) {
    throw OptionError("softscope " + command +
                      ": --calibration is missing; only a sequence folder has its own");
  } else if (right.empty()) {
    paths.stereo = left;
  } else {
    paths.left = left;
    paths.right = right;
  }
  if (!calibration.empty()) paths.calibration = calibration;
  if (!mask.empty()) paths.mask = mask;
  return paths;
}

void SequenceArguments::applyFrames(SequenceOptions& options) const {
  if (!frames.empty()) options.frames = parseFrameRange(frames);
}

}  // namespace softscope
